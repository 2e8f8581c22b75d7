// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/io/euroc_sequence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <variant>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint {
namespace {

/// As the datasets write it: no first line for OpenCV, lists over several lines, comments behind values.
std::string sensor(const std::string& t_x, const std::string& lens = "radial-tangential") {
  return "# General sensor definitions.\nsensor_type: camera\ncomment: a camera cam0 (two of them)\n\n"
         "# Sensor extrinsics wrt. the body-frame.\nT_BS:\n  cols: 4\n  rows: 4\n"
         "  data: [0.0, 0.0, 1.0, " +
         t_x +
         ",\n         -1.0, 0.0, 0.0, 0.2,\n        0.0, -1.0, 0.0, 0.3,\n         0.0, 0.0, 0.0, 1.0]\n\n"
         "rate_hz: 20\nresolution: [64, 48]\ncamera_model: pinhole\n"
         "intrinsics: [50.5, 50, 32, 23.5] #fu, fv, cu, cv\ndistortion_model: " +
         lens + "\ndistortion_coefficients: [-0.28, 0.07, 0.0002, 1.7e-05]\n\n";
}

/// Three moments of the left camera and three of the right one, two in common; images can be told by their values.
class EurocSequenceTest : public testing::Test {
 protected:
  EurocSequenceTest() {
    folder.write("mav0/cam0/sensor.yaml", sensor("0.1"));
    folder.write("mav0/cam1/sensor.yaml", sensor("0.1", "none"));
    folder.write("mav0/cam0/data.csv",
                 "#timestamp [ns],filename\r\n1403636579763555584,1403636579763555584.png\r\n"
                 "1403636579813555456,a.png\r\n1403636579863555584,1403636579863555584.png\r\n");
    folder.write("mav0/cam1/data.csv",
                 "#timestamp [ns],filename\n1403636579763555584, 1403636579763555584.png\n"
                 "1403636579813555457,a.png\n1403636579863555584,1403636579863555584.png\n");
    folder.write("mav0/state_groundtruth_estimate0/data.csv",
                 "#timestamp, p_RS_R_x [m], ...\n1403636579758555392,1,2,3,2,0,0,0,-0.02,0.1,0.03\n");
    for (const char* camera : {"cam0", "cam1"}) {
      const std::string data = std::string("mav0/") + camera + "/data/";
      const int value = camera[3] == '0' ? 10 : 20;
      image(data + "1403636579763555584.png", value);
      image(data + "a.png", 99);
      image(data + "1403636579863555584.png", value + 1);
    }
  }

  void image(const std::string& name, int value, int width = 64) {
    std::filesystem::create_directories((folder.path() / name).parent_path());
    ASSERT_TRUE(cv::imwrite((folder.path() / name).string(), cv::Mat(48, width, CV_8UC1, cv::Scalar(value))));
  }
  std::string message() {
    return error_of([&] { EurocSequence(folder.path()).load(0); });
  }
  std::string path(const std::string& name) { return (folder.path() / name).string(); }

  TemporaryFolder folder;
};

TEST_F(EurocSequenceTest, PairsAreImagesOfEqualTime) {
  const EurocSequence sequence(folder.path());
  EXPECT_EQ(sequence.folder(), folder.path());
  ASSERT_EQ(sequence.frames().size(), 2u);  // a nanosecond apart is not the same exposure
  EXPECT_EQ(sequence.images_without_partner(), 1u);
  EXPECT_NEAR(sequence.frames()[0].timestamp_s, 1403636579.763555584, 1e-6);
  EXPECT_NEAR(sequence.frames()[1].timestamp_s - sequence.frames()[0].timestamp_s, 0.1, 1e-6);
  const StereoImages images = sequence.load(1);
  EXPECT_EQ(images.left.at<cv::Vec3b>(0, 0), cv::Vec3b(11, 11, 11));
  EXPECT_EQ(images.right.at<cv::Vec3b>(47, 63), cv::Vec3b(21, 21, 21));
}

TEST_F(EurocSequenceTest, TakesMav0ItselfToo) { EXPECT_EQ(EurocSequence(folder.path() / "mav0").frames().size(), 2u); }

TEST_F(EurocSequenceTest, CamerasAreThoseOfTheirSensorFiles) {
  folder.write("mav0/cam1/sensor.yaml", sensor("0.21", "none"));
  const EurocSequence sequence(folder.path());
  EXPECT_EQ(sequence.left_camera().fx(), 50.5);
  EXPECT_EQ(sequence.left_camera().fy(), 50.0);
  EXPECT_EQ(sequence.left_camera().cx(), 32.0);
  EXPECT_EQ(sequence.left_camera().cy(), 23.5);
  EXPECT_EQ(sequence.left_camera().width(), 64);
  const auto& lens = std::get<BrownConrady>(sequence.left_camera().distortion().model);
  EXPECT_EQ(lens.k1, -0.28);
  EXPECT_EQ(lens.k2, 0.07);
  EXPECT_EQ(lens.p1, 0.0002);
  EXPECT_EQ(lens.p2, 1.7e-05);
  EXPECT_EQ(lens.k3, 0.0);
  EXPECT_TRUE(std::holds_alternative<NoDistortion>(sequence.right_camera().distortion().model));
  // The right camera is 0.11 m further along the body's x axis, which is the cameras' z axis (third column of T_BS):
  // its origin in the left camera is (0, 0, 0.11), and the left camera's origin in the right one is the opposite.
  EXPECT_TRUE(sequence.right_from_left().isApprox(Pose(Eigen::Translation3d(0, 0, -0.11)), 1e-12));
}

TEST_F(EurocSequenceTest, TakesAnEquidistantLens) {
  folder.write("mav0/cam0/sensor.yaml", sensor("0.1", "equidistant"));
  const EurocSequence sequence(folder.path());
  EXPECT_EQ(std::get<EquidistantFisheye>(sequence.left_camera().distortion().model).k3, 0.0002);
}

TEST_F(EurocSequenceTest, GroundTruthIsThatOfTheLeftCamera) {
  const EurocSequence sequence(folder.path());
  ASSERT_TRUE(sequence.ground_truth());
  ASSERT_EQ(sequence.ground_truth()->size(), 1u);
  const StampedPose& pose = sequence.ground_truth()->front();
  EXPECT_NEAR(pose.timestamp_s, 1403636579.758555392, 1e-6);
  // The body is not turned (the quaternion, of length 2, is the unit): camera = body + T_BS's translation.
  EXPECT_TRUE(pose.world_from_camera.translation().isApprox(Vector3d(1.1, 2.2, 3.3), 1e-12));
  EXPECT_TRUE((pose.world_from_camera.linear() * Vector3d::UnitZ()).isApprox(Vector3d::UnitX(), 1e-12));
  std::filesystem::remove_all(folder.path() / "mav0" / "state_groundtruth_estimate0");
  EXPECT_FALSE(EurocSequence(folder.path()).ground_truth());
}

TEST_F(EurocSequenceTest, MissingFolderIsNamed) {
  const std::string nowhere = path("nowhere"), empty = path("mav0/cam0/data");
  EXPECT_EQ(error_of([&] { EurocSequence{nowhere}; }),
            nowhere + ": found no such folder, expected the folder of a EuRoC sequence");
  EXPECT_EQ(error_of([&] { EurocSequence{empty}; }),
            empty + ": found no mav0/cam0 in it, expected the folder of a EuRoC sequence");
}

TEST_F(EurocSequenceTest, MissingFilesAreNamed) {
  std::filesystem::remove(path("mav0/cam1/data/a.png"));
  EXPECT_EQ(message(), path("mav0/cam1/data.csv") + ":3: found file name 'a.png', expected an image that is there; " +
                           path("mav0/cam1/data/a.png") + " is not");
  std::filesystem::remove(path("mav0/cam1/data.csv"));
  EXPECT_EQ(message(), path("mav0/cam1/data.csv") + ": no such file");
  std::filesystem::remove(path("mav0/cam1/sensor.yaml"));
  EXPECT_EQ(message(), path("mav0/cam1/sensor.yaml") + ": no such file");
}

// One of the left camera's ten images is missing: a tenth. It takes its pair along.
TEST_F(EurocSequenceTest, LeavesOutWhatIsMissingUpToATenth) {
  std::string rows = "#timestamp [ns],filename\n";
  for (int i = 0; i < 10; ++i) {
    const std::string name = std::to_string(1000 + i) + ".png";
    rows += std::to_string(1000 + i) + "," + name + "\n";
    for (const char* camera : {"cam0", "cam1"})
      if (i != 4 || camera[3] == '1') image(std::string("mav0/") + camera + "/data/" + name, i);
  }
  folder.write("mav0/cam0/data.csv", rows);
  folder.write("mav0/cam1/data.csv", rows);
  const EurocSequence sequence(folder.path());
  EXPECT_EQ(sequence.frames().size(), 9u);
  EXPECT_EQ(sequence.missing_files(), 1u);
  EXPECT_EQ(sequence.load(4).left.at<cv::Vec3b>(0, 0)[0], 5) << "the fourth is left out";
}

TEST_F(EurocSequenceTest, RowsThatMakeNoSenseAreNamed) {
  const std::string file = path("mav0/cam0/data.csv");
  const auto message_of = [&](const std::string& text) {
    folder.write("mav0/cam0/data.csv", text);
    return message();
  };
  EXPECT_EQ(message_of("#\n1,a.png,2\n"), file + ":2: found 3 columns, expected 2: timestamp [ns],filename");
  EXPECT_EQ(message_of("1 a.png\n"), file + ":1: found 1 columns, expected 2: timestamp [ns],filename");
  EXPECT_EQ(message_of("1.5,a.png\n"), file + ":1: found timestamp '1.5', expected a whole number of nanoseconds");
  EXPECT_EQ(message_of(",a.png\n"), file + ":1: found timestamp '', expected a whole number of nanoseconds");
  EXPECT_EQ(message_of("7,a.png\n7,a.png\n"),
            file + ":2: found timestamp '7', expected later than 7 ns, the time of the row before");
  EXPECT_EQ(message_of("7,a.png\n8,a.png\n"),
            path("mav0") + ": found no pair among 2 images of cam0 and 3 of cam1, expected equal times");
  EXPECT_EQ(message_of(""),
            path("mav0") + ": found no pair among 0 images of cam0 and 3 of cam1, expected equal times");
}

TEST_F(EurocSequenceTest, GroundTruthThatMakesNoSenseIsNamed) {
  const std::string name = "mav0/state_groundtruth_estimate0/data.csv", file = path(name);
  const auto message_of = [&](const std::string& text) {
    folder.write(name, text);
    return message();
  };
  EXPECT_EQ(message_of("#\n1,2,3\n"),
            file + ":2: found 3 columns, expected at least 8: timestamp [ns], p x y z, q w x y z");
  EXPECT_EQ(message_of("1,1,2,x,1,0,0,0\n"), file + ":1: found p_z 'x', expected a finite number");
  EXPECT_EQ(message_of("1,1,2,,1,0,0,0\n"), file + ":1: found p_z '', expected a finite number");
  EXPECT_EQ(message_of("1,1,2,3,nan,0,0,0\n"), file + ":1: found q_w 'nan', expected a finite number");
  EXPECT_EQ(message_of("1,1,2,3,0,0,0,0\n"),
            file + ":1: found a quaternion of length zero, expected q w x y z of length one");
  EXPECT_EQ(message_of("2,1,2,3,1,0,0,0\n1,1,2,3,1,0,0,0\n"),
            file + ":2: found timestamp '1', expected later than 2 ns, the time of the row before");
}

TEST_F(EurocSequenceTest, SensorFilesThatMakeNoSenseAreNamed) {
  const std::string file = path("mav0/cam0/sensor.yaml");
  const auto message_with = [&](const std::string& good, const std::string& bad) {
    std::string text = sensor("0.1");
    const std::size_t at = text.find(good);
    EXPECT_NE(at, std::string::npos) << good;
    folder.write("mav0/cam0/sensor.yaml", text.replace(at, good.size(), bad));
    return without_line(message());
  };
  const std::string rigid = ", expected a rigid transform of 4 x 4 numbers, row by row, in T_BS: data";
  EXPECT_EQ(message_with("T_BS", "T_SB"), file + ": T_BS is missing" + rigid);
  EXPECT_EQ(message_with("data: [0.0,", "data: ["), file + ": T_BS has 15 entries" + rigid);
  EXPECT_EQ(message_with("data: [0.0, 0.0, 1.0", "data: [0.0, 0.0, 1.1"),
            file + ": T_BS is no rotation and translation" + rigid);
  EXPECT_EQ(message_with("data: [0.0, 0.0, 1.0", "data: [0.0, 0.0, -1.0"),
            file + ": T_BS is no rotation and translation" + rigid);
  EXPECT_EQ(message_with("data: [0.0, 0.0, 1.0", "data: [0.0, 0.0, .Nan"),
            file + ": T_BS has an entry that is not finite" + rigid);
  EXPECT_EQ(message_with("resolution: [64, 48]", "resolution: [64.5, 48]"),
            file + ": resolution holds 64.5, expected width and height, whole numbers of pixels from 1 to 65535");
  EXPECT_EQ(message_with("[50.5, 50, 32, 23.5]", "50.5"),
            file + ": intrinsics is not a list, expected fu fv cu cv in pixels");
  EXPECT_EQ(message_with("[50.5, 50, 32, 23.5]", "[50.5, fv, 32, 23.5]"),
            file + ": intrinsics has an entry that is 'fv', expected fu fv cu cv in pixels");
  EXPECT_EQ(message_with("[50.5, 50,", "[50.5, -50,"),
            file + ": intrinsics holds -50, expected positive focal lengths in pixels");
  EXPECT_EQ(message_with("camera_model: pinhole", "camera_model: omni"),
            file + ": camera_model is 'omni', expected pinhole");
  EXPECT_EQ(message_with("radial-tangential", "fov"),
            file + ": distortion_model is 'fov', expected radial-tangential, equidistant or none");
  EXPECT_EQ(message_with(", 1.7e-05]", "]"),
            file + ": distortion_coefficients has 3 entries, expected the four numbers k1 k2 p1 p2");
  message_with("camera_model: pinhole\n", "camera_model: pinhole\n   rate: 3\n");
  EXPECT_EQ(message().find(file + ":17: "), 0u) << message();
}

TEST_F(EurocSequenceTest, ImagesOfAnotherSizeAreNamed) {
  image("mav0/cam1/data/1403636579763555584.png", 5, 62);
  EXPECT_EQ(message(),
            path("mav0/cam1/data/1403636579763555584.png") + ": found 62 x 48 pixels, expected the camera's 64 x 48");
  folder.write("mav0/cam1/data/1403636579763555584.png", "no image");
  EXPECT_EQ(message(),
            path("mav0/cam1/data/1403636579763555584.png") + ": cannot be read, expected a whole PNG or JPEG image");
  EXPECT_EQ(error_of([&] { EurocSequence(folder.path()).load(2); }),
            folder.path().string() + ": frame 2 is asked for, expected one below 2");
}

}  // namespace
}  // namespace stillpoint
