// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/io/camera_file.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <variant>

#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint {
namespace {

using Fields = std::map<std::string, std::string>;

/// A good camera file with some fields replaced or added; a field replaced by nothing is left out.
std::string yaml(const Fields& changes = {}) {
  Fields fields = {{"fx", "525.0"},  {"fy", "526"},     {"cx", "320.5"},           {"cy", "240.25"},
                   {"width", "640"}, {"height", "480"}, {"depth_factor", "5000.0"}};
  for (const auto& [name, value] : changes) fields[name] = value;
  std::string text = "%YAML:1.0\n---\n";
  for (const auto& [name, value] : fields)
    if (!value.empty()) text += name + ": " + value + "\n";
  return text;
}

/// What the reader says, without the file's name.
std::string message_of(const std::string& text) {
  const TemporaryFolder folder;
  const auto file = folder.write("camera.yaml", text);
  const std::string message = without_line(error_of([&] { read_camera(file); }));
  const std::string where = file.string() + ": ";
  EXPECT_EQ(message.substr(0, where.size()), where) << message;
  return message.size() > where.size() ? message.substr(where.size()) : "";
}

RgbdCamera camera_of(const Fields& changes) {
  const TemporaryFolder folder;
  return read_camera(folder.write("camera.yaml", yaml(changes)));
}

TEST(ReadCamera, TakesIntrinsicsAndDepthFactor) {
  const RgbdCamera found = camera_of({{"width", "640.0"}, {"depth_factor", "1000"}});
  EXPECT_EQ(found.camera.fx(), 525.0);
  EXPECT_EQ(found.camera.fy(), 526.0);
  EXPECT_EQ(found.camera.cx(), 320.5);
  EXPECT_EQ(found.camera.cy(), 240.25);
  EXPECT_EQ(found.camera.width(), 640);
  EXPECT_EQ(found.camera.height(), 480);
  EXPECT_EQ(found.depth_factor, 1000.0);
  EXPECT_TRUE(std::holds_alternative<NoDistortion>(found.camera.distortion().model));
}

TEST(ReadCamera, TakesTheLensModel) {
  EXPECT_TRUE(std::holds_alternative<NoDistortion>(camera_of({{"model", "pinhole"}}).camera.distortion().model));

  const Fields brown = {{"k1", "0.1"}, {"k2", "-0.2"}, {"p1", "0.003"}, {"p2", "-0.004"}, {"k3", "0.5"}};
  for (const char* model : {"brown_conrady", ""}) {
    Fields fields = brown;
    fields["model"] = model;
    const auto lens = std::get<BrownConrady>(camera_of(fields).camera.distortion().model);
    EXPECT_EQ(lens.k1, 0.1);
    EXPECT_EQ(lens.k2, -0.2);
    EXPECT_EQ(lens.p1, 0.003);
    EXPECT_EQ(lens.p2, -0.004);
    EXPECT_EQ(lens.k3, 0.5);
    fields["k3"] = "";
    EXPECT_EQ(std::get<BrownConrady>(camera_of(fields).camera.distortion().model).k3, 0.0);
  }

  const auto lens = std::get<EquidistantFisheye>(
      camera_of({{"model", "equidistant"}, {"k1", "0.1"}, {"k2", "0.2"}, {"k3", "0.3"}, {"k4", "0"}})
          .camera.distortion()
          .model);
  EXPECT_EQ(lens.k1, 0.1);
  EXPECT_EQ(lens.k2, 0.2);
  EXPECT_EQ(lens.k3, 0.3);
  EXPECT_EQ(lens.k4, 0.0);
}

TEST(ReadCamera, NamesAMissingField) {
  for (const char* field : {"fx", "fy"})
    EXPECT_EQ(message_of(yaml({{field, ""}})),
              std::string(field) + " is missing, expected a positive focal length in pixels");
  for (const char* field : {"cx", "cy"})
    EXPECT_EQ(message_of(yaml({{field, ""}})),
              std::string(field) + " is missing, expected a finite principal point in pixels");
  for (const char* field : {"width", "height"})
    EXPECT_EQ(message_of(yaml({{field, ""}})),
              std::string(field) + " is missing, expected a whole number of pixels from 1 to 65535");
  EXPECT_EQ(message_of(yaml({{"depth_factor", ""}})),
            "depth_factor is missing, expected the positive number that a depth image counts per metre");
}

TEST(ReadCamera, NamesAValueThatMakesNoSense) {
  EXPECT_EQ(message_of(yaml({{"fx", "wide"}})), "fx is 'wide', expected a positive focal length in pixels");
  EXPECT_EQ(message_of(yaml({{"fy", "-5"}})), "fy is -5, expected a positive focal length in pixels");
  EXPECT_EQ(message_of(yaml({{"cx", ".Nan"}})), "cx is not finite, expected a finite principal point in pixels");
  EXPECT_EQ(message_of(yaml({{"cy", "[1, 2]"}})), "cy is a list, expected a finite principal point in pixels");
  EXPECT_EQ(message_of(yaml({{"width", "640.5"}})),
            "width is 640.5, expected a whole number of pixels from 1 to 65535");
  EXPECT_EQ(message_of(yaml({{"height", "0"}})), "height is 0, expected a whole number of pixels from 1 to 65535");
  EXPECT_EQ(message_of(yaml({{"width", "1e12"}})).substr(0, 9), "width is ");
  EXPECT_EQ(message_of(yaml({{"depth_factor", "0"}})),
            "depth_factor is 0, expected the positive number that a depth image counts per metre");
  EXPECT_EQ(message_of(yaml({{"depth_factor", "-1e-9"}})),
            "depth_factor is -1e-09, expected the positive number that a depth image counts per metre");
  EXPECT_EQ(message_of(yaml({{"depth_factor", "1e9"}})),
            "depth_factor is 1e+09, expected what a depth image counts per metre: 0.001 to 1000000");
}

TEST(ReadCamera, NamesAModelOrCoefficientThatDoesNotFit) {
  EXPECT_EQ(message_of(yaml({{"model", "fov"}})), "model is 'fov', expected pinhole, brown_conrady or equidistant");
  EXPECT_EQ(message_of(yaml({{"model", "7"}})), "model is not a word, expected pinhole, brown_conrady or equidistant");
  EXPECT_EQ(message_of(yaml({{"k1", "0.1"}})),
            "k1 is given without a model, expected model: pinhole, brown_conrady or equidistant");
  EXPECT_EQ(message_of(yaml({{"model", "pinhole"}, {"k2", "0.1"}})),
            "k2 is given with model pinhole, expected a pinhole to have no coefficients");
  EXPECT_EQ(message_of(yaml({{"model", "brown_conrady"}, {"k1", "1"}, {"k2", "1"}, {"p1", "1"}})),
            "p2 is missing, expected a coefficient of the lens model");
  EXPECT_EQ(message_of(yaml({{"model", "brown_conrady"}, {"k4", "1"}})),
            "k4 is given with model brown_conrady, expected k1 k2 p1 p2 and optionally k3");
  EXPECT_EQ(message_of(yaml({{"model", "equidistant"}, {"k1", "1"}, {"k2", "1"}, {"k3", "1"}})),
            "k4 is missing, expected a coefficient of the lens model");
  EXPECT_EQ(message_of(yaml({{"model", "equidistant"}, {"p2", "1"}})),
            "p2 is given with model equidistant, expected k1 k2 k3 k4");
}

TEST(ReadCamera, NamesTheCoefficientsOfAnotherLens) {
  const Fields brown = {{"k1", "0.1"}, {"k2", "-0.2"}, {"p1", "0.003"}, {"p2", "-0.004"}};
  const Fields fisheye = {{"model", "equidistant"}, {"k1", "0.1"}, {"k2", "0.2"}, {"k3", "0.3"}, {"k4", "0.4"}};
  const auto with = [](Fields fields, const char* name) {
    fields[name] = "0.5";
    return message_of(yaml(fields));
  };
  for (const std::string name : {"k4", "k5", "k6", "k12", "p3"})  // a rational lens, and one with more tangential terms
    for (const std::string model : {"", "brown_conrady"}) {
      Fields fields = brown;
      fields["model"] = model;
      EXPECT_EQ(with(fields, name.c_str()),
                name + " is given with model brown_conrady, expected k1 k2 p1 p2 and optionally k3");
    }
  for (const std::string name : {"p1", "p2", "p3", "k5", "k6"})
    EXPECT_EQ(with(fisheye, name.c_str()), name + " is given with model equidistant, expected k1 k2 k3 k4");
  EXPECT_EQ(with({{"model", "pinhole"}}, "k5"),
            "k5 is given with model pinhole, expected a pinhole to have no coefficients");
  EXPECT_EQ(with({}, "k5"), "k5 is given without a model, expected model: pinhole, brown_conrady or equidistant");
}

TEST(ReadCamera, NamesALensThatIsSpelledOtherwise) {
  const std::string expected =
      " is not read, expected k1 k2 p1 p2 and optionally k3, or model: equidistant and k1 k2 k3 k4";
  for (const std::string name : {"K1", "K6", "distortion", "Distortion", "dist", "D", "d", "dist_coeffs", "distCoeffs",
                                 "distortion_coefficients", "distortion_coeffs", "coeffs"})
    for (const char* model : {"", "pinhole", "equidistant"})
      EXPECT_EQ(message_of(yaml({{name, "[0.1, 0.2, 0, 0]"}, {"model", model}})), name + expected);
}

TEST(ReadCamera, FieldsOfOtherProgramsAreNoLens) {
  for (const std::string name : {"Camera.k1", "Camera.fps", "K", "P", "P0", "R", "k", "p", "kf1", "dt", "distance_m",
                                 "distortion_model", "camera_model", "ThDepth", "ORBextractor.nFeatures", "note"})
    EXPECT_EQ(camera_of({{name, "[0.1, 0.2]"}}).camera.fx(), 525.0) << name;
}

TEST(ReadCamera, FileThatIsNoYamlIsNamed) {
  for (const std::string& text :
       {std::string("[fx, fy]\n"), std::string(), std::string("\x01\x02\xff", 3),
        std::string("%YAML:1.0\n---\nfx: [1, 2\n"), std::string("%YAML:1.0\n---\n  : :\n}")}) {
    const std::string message = message_of(text);
    EXPECT_TRUE(message.find("expected") != std::string::npos || message == "cannot be read") << message;
  }
}

TEST(ReadCamera, TheLineOfBrokenYamlIsNamed) {
  const TemporaryFolder folder;
  const auto file = folder.write("camera.yaml", "%YAML:1.0\n---\nfx: 5\n   fy: 6\n");
  EXPECT_EQ(error_of([&] { read_camera(file); }), file.string() + ":4: illegal map value, expected YAML");
}

TEST(ReadCamera, TheLineOfAWrongFieldIsNamed) {
  const TemporaryFolder folder;
  const auto file = folder.write("camera.yaml", "fx: 5\n\nfy: wide\n");
  EXPECT_EQ(error_of([&] { read_camera(file); }),
            file.string() + ":3: fy is 'wide', expected a positive focal length in pixels");
}

// As robots have it, and as OpenCV writes it.
TEST(ReadCamera, TakesPlainYaml) {
  const TemporaryFolder folder;
  const std::string with_first_line = yaml({{"k1", "0.1"}, {"k2", "0"}, {"p1", "0"}, {"p2", "0"}});
  const std::string plain = with_first_line.substr(with_first_line.find("---\n") + 4);
  for (const std::string& text : {plain, "---\n" + plain, "%YAML 1.2\n---\n" + plain, "# a camera\n" + plain})
    EXPECT_EQ(read_camera(folder.write("camera.yaml", text)).camera.cy(), 240.25) << text;
}

TEST(ReadImageCamera, NeedsNoDepthFactorAndTakesABaseline) {
  const TemporaryFolder folder;
  const auto read = [&folder](const Fields& changes) {
    return read_image_camera(folder.write("camera.yaml", yaml(changes)));
  };
  EXPECT_EQ(read({{"depth_factor", ""}}).camera.cy(), 240.25);
  EXPECT_FALSE(read({}).baseline_m);
  EXPECT_EQ(read({{"baseline_m", "0.12"}}).baseline_m, 0.12);
  EXPECT_EQ(camera_of({{"baseline_m", "0.12"}}).baseline_m, 0.12);
  EXPECT_FALSE(camera_of({}).baseline_m);
  const std::string where = (folder.path() / "camera.yaml").string() + ": ";
  EXPECT_EQ(without_line(error_of([&] {
              read({{"baseline_m", "-0.1"}});
            })),
            where + "baseline_m is -0.1, expected the positive distance of the two cameras in metres");
  EXPECT_EQ(error_of([&] { read({{"fx", ""}}); }), where + "fx is missing, expected a positive focal length in pixels");
}

TEST(ReadCamera, MissingFileAndFolderAreNamed) {
  const TemporaryFolder folder;
  const auto missing = folder.path() / "camera.yaml";
  EXPECT_EQ(error_of([&] { read_camera(missing); }), missing.string() + ": no such file");
  EXPECT_EQ(error_of([&] { read_camera(folder.path()); }),
            folder.path().string() + ": found a folder, expected a file");
}

TEST(CameraOfTumFolder, IsToldByTheName) {
  const auto first = camera_of_tum_folder("data/rgbd_dataset_freiburg1_xyz");
  ASSERT_TRUE(first);
  EXPECT_EQ(first->camera.fx(), 517.3);
  EXPECT_EQ(first->camera.cy(), 255.3);
  EXPECT_EQ(std::get<BrownConrady>(first->camera.distortion().model).k3, 1.1633);
  EXPECT_EQ(first->depth_factor, 5000.0);

  const auto second = camera_of_tum_folder("rgbd_dataset_freiburg2_desk/");
  ASSERT_TRUE(second);
  EXPECT_EQ(second->camera.fy(), 521.0);
  EXPECT_EQ(std::get<BrownConrady>(second->camera.distortion().model).p2, -0.0001);

  const auto third = camera_of_tum_folder("rgbd_dataset_freiburg3_walking_xyz/.");
  ASSERT_TRUE(third);
  EXPECT_EQ(third->camera.fx(), 535.4);
  EXPECT_EQ(third->camera.width(), 640);
  EXPECT_TRUE(std::holds_alternative<NoDistortion>(third->camera.distortion().model));
}

TEST(CameraOfTumFolder, OtherNamesSayNothing) {
  EXPECT_FALSE(camera_of_tum_folder("kitchen_walk"));
  EXPECT_FALSE(camera_of_tum_folder("freiburg1/kitchen_walk"));
}

}  // namespace
}  // namespace stillpoint
