// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/model_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "stillpoint/detectors/model_input_size.hpp"
#include "unit/detectors/made_tensor.hpp"
#include "unit/temporary_folder.hpp"

#if defined(__unix__)
#include <sys/stat.h>
#endif

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

TEST(ModelFiles, TheOtherHalfIsFoundByItsName) {
  const TemporaryFolder folder;
  const fs::path& here = folder.path();
  for (const char* name : {"net.weights", "net.cfg", "net.pb", "with.pb", "with.pbtxt", "net.onnx"})
    write(here / name, "");
  for (const char* name : {"net.weights", "net.cfg"}) {
    const ModelFiles files = find_model_files(here / name);
    EXPECT_EQ(files.model, here / "net.weights");
    EXPECT_EQ(files.config, here / "net.cfg");
  }
  EXPECT_TRUE(find_model_files(here / "net.pb").config.empty());
  EXPECT_EQ(find_model_files(here / "with.pb").config, here / "with.pbtxt");
  EXPECT_TRUE(find_model_files(here / "net.onnx").config.empty());
  EXPECT_EQ(find_model_files(here / "net.pb", here / "with.pbtxt").config, here / "with.pbtxt");
}

TEST(ModelFiles, ErrorsNameTheFile) {
  const TemporaryFolder folder;
  const fs::path& here = folder.path();
  write(here / "alone.weights", "");
  write(here / "net.tflite", "");
  EXPECT_EQ(error_of([&] { find_model_files(here / "none.onnx"); }), (here / "none.onnx").string() + ": no such file");
  EXPECT_EQ(error_of([&] { find_model_files(here / "alone.weights"); }),
            (here / "alone.cfg").string() + ": no such file");
  expect_contains(error_of([&] { find_model_files(here); }), "found a folder, expected a model");
  expect_contains(error_of([&] { find_model_files(here / "net.tflite"); }),
                  "found the ending '.tflite', expected .onnx");
}

#if defined(__unix__)
TEST(ModelFiles, APipeIsNoModel) {  // reading it would wait for ever
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "net.onnx", half = folder.path() / "net.cfg";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(half.c_str(), 0600), 0);
  write(folder.path() / "net.weights", "");
  EXPECT_EQ(error_of([&] { find_model_files(pipe); }), pipe.string() + ": found a pipe or a device, expected a model");
  EXPECT_EQ(error_of([&] { find_model_files(folder.path() / "net.weights"); }),
            half.string() + ": found a pipe or a device, expected a model");
}
#endif

TEST(ModelInputSize, DarknetSaysItInItsFirstSection) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "net.cfg";
  write(file, "[net]\r\n# width=1\n width = 320\nheight=192\n[convolutional]\nwidth=7\nheight=7\n");
  EXPECT_EQ(darknet_input_size(file).width, 320);
  EXPECT_EQ(darknet_input_size(file).height, 192);
  EXPECT_EQ(darknet_input_size("/no/such.cfg").width, 0);
}

TEST(ModelInputSize, WhatIsNoNumberInADarknetFileIsNamed) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "net.cfg";
  const auto error = [&](const std::string& line) {
    write(file, "[net]\n" + line + "\n");
    return error_of([&] { darknet_input_size(file); });
  };
  const std::string expected = ", expected a whole number of pixels from 1 to 8192";
  EXPECT_EQ(error("width=99999999999"), file.string() + ":2: width is '99999999999'" + expected);
  EXPECT_EQ(error("height = abc"), file.string() + ":2: height is 'abc'" + expected);
  EXPECT_EQ(error("width=320.5"), file.string() + ":2: width is '320.5'" + expected);
  EXPECT_EQ(error("width="), file.string() + ":2: width is ''" + expected);
  EXPECT_EQ(error("width=320 # of the camera"), "no error");
}

/// A field of protobuf: number and bytes.
std::string field(int number, const std::string& bytes) {
  std::string result(1, static_cast<char>(number << 3 | 2));
  std::size_t size = bytes.size();
  for (; size > 127; size >>= 7) result += static_cast<char>((size & 127) | 128);
  return result + static_cast<char>(size) + bytes;
}
std::string integer(int number, int value) {
  std::string result(1, static_cast<char>(number << 3));
  for (; value > 127; value >>= 7) result += static_cast<char>((value & 127) | 128);
  return result + static_cast<char>(value);
}

TEST(ModelInputSize, OnnxSaysItInItsFirstPicture) {
  const auto input = [](const std::string& name, std::initializer_list<int> extents) {
    std::string dimensions;
    for (const int extent : extents) dimensions += field(1, integer(1, extent));
    return field(11, field(1, name) + field(2, field(1, integer(1, 1) + field(2, dimensions))));
  };
  const std::string graph = field(5, std::string(1000, 'w')) + input("orig_target_sizes", {1, 2}) +
                            input("conv1.weight", {64, 3, 7, 7}) + input("depth", {1, 1, 64, 64}) +
                            input("image", {1, 3, 192, 320});
  const std::string model = integer(1, 8) + field(2, "a test") + field(7, graph);
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "net.onnx";
  write(file, model);
  EXPECT_EQ(onnx_input_size(file).width, 320);
  EXPECT_EQ(onnx_input_size(file).height, 192);
  for (std::size_t size = 0; size < model.size(); size += 7) {  // cut short: nothing, or nothing worse
    write(file, model.substr(0, size));
    EXPECT_EQ(onnx_input_size(file).width, 0) << size;
  }
  write(file, std::string(500, '\xff'));
  EXPECT_EQ(onnx_input_size(file).width, 0);
  EXPECT_EQ(onnx_input_size("/no/such.onnx").width, 0);
}

}  // namespace
}  // namespace stillpoint
