// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/io/yaml_file.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint {
namespace {

class YamlFileTest : public testing::Test {
 protected:
  /// What is said of a file, without its name.
  std::string error(const std::string& text) {
    const std::filesystem::path file = folder.write("fields.yaml", text);
    const std::string message = error_of([&] { YamlFile{file}; });
    return message.rfind(file.string(), 0) == 0 ? message.substr(file.string().size()) : message;
  }
  YamlFile read(const std::string& text) { return YamlFile(folder.write("fields.yaml", text)); }

  TemporaryFolder folder;
};

std::string repeated(std::size_t count, const std::string& text) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

// OpenCV's parser overflowed its stack at 40 000 of them.
TEST_F(YamlFileTest, NestingIsLimited) {
  const std::string expected = ":1: nested more than 32 deep, expected fields as name: value";
  EXPECT_EQ(error("a: " + repeated(40000, "[") + repeated(40000, "]")), expected);
  EXPECT_EQ(error(repeated(100000, "{a: ") + repeated(100000, "}")), expected);
  for (const char* open : {"[", "{", "{a: ", "? ", "- [", "a: ["})  // not closed
    EXPECT_NE(error("a: " + repeated(40000, open)), "no error") << open;
  EXPECT_EQ(error(repeated(400000, "- ")), expected);
  EXPECT_EQ(error("a: " + repeated(31, "[") + repeated(31, "]")), "no error");
  std::string indented;
  for (std::size_t depth = 0; depth < 1000; ++depth) indented += std::string(depth, ' ') + "a:\n";
  EXPECT_EQ(error(indented), ":33: nested more than 32 deep, expected fields as name: value");
}

TEST_F(YamlFileTest, SizeIsLimited) {
  EXPECT_EQ(error("a: 1\n#" + std::string(YamlFile::kLargestBytes, '-')),
            ": is too large, expected at most 1000000 bytes");
  EXPECT_EQ(error("a: 1\n#" + std::string(YamlFile::kLargestBytes - 6, '-')), "no error");
}

// A list as root and an empty name were cv::Exception and std::length_error.
TEST_F(YamlFileTest, WhatIsNoMapOfNamesIsRefused) {
  const std::string expected = ", expected fields as name: value";
  EXPECT_EQ(error("- 1\n- 2\n"), ":1: is no map" + expected);
  EXPECT_EQ(error("\nword\n"), ":2: is no map" + expected);
  EXPECT_EQ(error("a: 1\n: 2\n"), ":2: a name is empty" + expected);
  EXPECT_EQ(error("? [a, b]\n: 2\n"), ":1: a name is a list or map" + expected);
  EXPECT_EQ(error("a: &here [1]\nb: *here\n"), ":2: an alias is not read here" + expected);
  EXPECT_EQ(error("a: 1\nb: 2\na: 3\n"), ":3: a is there twice" + expected);
  EXPECT_EQ(error("a: 1\n---\nb: 2\n"), ": has two documents, expected one");
  EXPECT_EQ(error("a: [1, 2\nb: 3\n"), ":2: end of sequence flow not found, expected YAML");
  EXPECT_EQ(error(""), "no error") << "a map of nothing";
  for (const std::string& text :
       {std::string("\0\0", 2), std::string("\xff\xfe\xfd"), std::string("%"), std::string("%YAML:"),
        std::string("%YAML 7.0\n---\n"), std::string("\"\\"), std::string("!<"), std::string("a: |9999999999\n"),
        std::string("&"), std::string("? ")})
    EXPECT_NO_THROW(error(text)) << text;  // it may be read or not; what is thrown is an Error
}

TEST_F(YamlFileTest, NumbersAndWordsAreToldApart) {
  const YamlFile fields =
      read("a: 5\nb: 5.\nc: -1.5e-3\nd: '5'\ne: word\nf: +2\ng: .inf\nh: .Nan\ni:\nj: [1]\nk: {l: 1}\n");
  EXPECT_EQ(fields.number("a", "x"), 5.0);
  EXPECT_EQ(fields.number("b", "x"), 5.0);
  EXPECT_EQ(fields.number("c", "x"), -1.5e-3);
  EXPECT_EQ(fields.number("f", "x"), 2.0);
  EXPECT_EQ(fields.text("d", "x"), "5");
  EXPECT_EQ(fields.text("e", "x"), "word");
  const std::pair<const char*, const char*> no_numbers[] = {
      {"d", "is \"5\", in quotes"}, {"e", "is 'word'"}, {"i", "is empty"}, {"j", "is a list"}, {"k", "is a map"}};
  for (const auto& [name, is_what] : no_numbers) {
    const char* const field = name;
    EXPECT_NE(error_of([&] { fields.number(field, "x"); }).find(std::string(field) + ' ' + is_what + ", expected x"),
              std::string::npos)
        << field;
  }
  for (const char* field : {"g", "h"})
    EXPECT_NE(error_of([&] { fields.number(field, "x"); }).find("is not finite"), std::string::npos);
  EXPECT_NE(error_of([&] { fields.text("a", "x"); }).find(":1: a is not a word"), std::string::npos);
}

TEST_F(YamlFileTest, WhatOpenCvWritesIsRead) {
  const std::string file = (folder.path() / "opencv.yaml").string();
  cv::FileStorage storage(file, cv::FileStorage::WRITE);
  storage << "fx" << 525.0 << "width" << 640 << "k1" << -1.25e-7 << "model"
          << "pinhole"
          << "note"
          << "a: b, \"c\" # d";
  storage << "large" << 5e300 << "empty"
          << "";
  storage << "T" << cv::Mat(cv::Mat::eye(4, 4, CV_64F)) << "list" << std::vector<double>(40, 0.1);
  storage << "group"
          << "{"
          << "inner" << 7 << "}";
  storage.release();
  const YamlFile fields{std::filesystem::path(file)};
  EXPECT_EQ(fields.number("fx", "x"), 525.0);
  EXPECT_EQ(fields.size("width"), 640);
  EXPECT_EQ(fields.number("k1", "x"), -1.25e-7);
  EXPECT_EQ(fields.number("large", "x"), 5e300);
  EXPECT_EQ(fields.text("model", "x"), "pinhole");
  EXPECT_EQ(fields.text("note", "x"), "a: b, \"c\" # d");
  EXPECT_EQ(fields.text("empty", "x"), "");
  ASSERT_NE(fields.find("T"), nullptr);
  ASSERT_NE(fields.find("T")->find("data"), nullptr);
  EXPECT_EQ(fields.find("T")->find("data")->entries.size(), 16u);
  EXPECT_EQ(fields.find("T")->find("data")->entries[5].number(), 1.0);
  EXPECT_EQ(fields.find("list")->entries.size(), 40u);
  EXPECT_EQ(fields.find("group")->find("inner")->number(), 7.0);
}

}  // namespace
}  // namespace stillpoint
