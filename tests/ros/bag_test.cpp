// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// stillpoint_run --bag on bags that this test writes: that it reads what is in them, which topics it takes, what is
// wrong.

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bag/rgbd_bag.hpp"
#include "system/run_program.hpp"
#include "system/small_sequence.hpp"
#include "unit/error_of.hpp"

namespace bag_test {
namespace {

using stillpoint::as_mat;
using system_test::expect_error, system_test::files_in, system_test::quoted, system_test::run_program;
namespace fs = std::filesystem;

constexpr int kFrames = 5;

/// What a bag has that is not as usual.
struct Contents {
  std::string encoding = "bgr8", depth_encoding = "16UC1", distortion_model = "plumb_bob";
  std::vector<double> distortion = {0, 0, 0, 0, 0};
  double depth_late_s = 0.0;  ///< by its stamp
  bool has_depth = true, has_camera_info = true, has_second_image = false;
  bool has_projection = false;  ///< P is the camera's matrix, and K is another's
  int depthless_frame = -1;
  int small_frame = -1;  ///< whose image is of half the size, and whose camera_info says so
  int refocused_frame = -1;
  double refocused_by_px = 0;  ///< what is added to its fx
};

template <class Message>
void write(rosbag::Bag& bag, const std::string& topic, const Message& message) {
  bag.write(topic, message.header.stamp, message);
}

sensor_msgs::Image message(const cv::Mat& image, const std::string& encoding, double stamp_s) {
  sensor_msgs::Image message;
  message.header.stamp.fromSec(stamp_s);
  message.width = static_cast<std::uint32_t>(image.cols);
  message.height = static_cast<std::uint32_t>(image.rows);
  message.encoding = encoding;
  message.step = static_cast<std::uint32_t>(image.step[0]);
  message.data.assign(image.data, image.data + image.total() * image.elemSize());
  return message;
}

stillpoint::synthetic::Scene scene() {
  stillpoint::synthetic::SceneOptions options;
  options.frames = kFrames;
  options.width = 160;
  options.height = 120;
  return stillpoint::synthetic::demo(options);
}

/// The frames of `write_small_sequence`, 5000 units of depth per metre.
void write_bag(const fs::path& file, const Contents& contents = {}) {
  rosbag::Bag bag(file.string(), rosbag::bagmode::Write);
  stillpoint::SyntheticSequence sequence(scene());
  stillpoint::SyntheticFrame frame;
  for (int i = 0; i < kFrames; ++i) {
    sequence.render(i, frame);
    const double stamp_s = std::round(1e6 * frame.timestamp_s) / 1e6;  // as names of files say it
    cv::Mat image = as_mat(frame.colour.view()), depth = as_mat(frame.depth.view());
    if (contents.encoding == "rgb8") cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
    if (contents.encoding == "mono8") image = as_mat(frame.gray.view());
    if (contents.depth_encoding == "32FC1") depth.convertTo(depth, CV_32F, 1 / 5000.0);
    const bool is_small = i == contents.small_frame;
    if (is_small) cv::resize(image, image, {}, 0.5, 0.5);
    const sensor_msgs::Image image_message = message(image, contents.encoding, stamp_s);
    write(bag, "/camera/rgb/image_color", image_message);
    if (contents.has_second_image) write(bag, "/camera/infra/image", image_message);
    if (contents.has_depth && i != contents.depthless_frame)
      write(bag, "/camera/depth/image", message(depth, contents.depth_encoding, stamp_s + contents.depth_late_s));
    if (!contents.has_camera_info) continue;
    const stillpoint::Camera& camera = sequence.camera();
    sensor_msgs::CameraInfo info;
    info.header = image_message.header;
    info.width = static_cast<std::uint32_t>(camera.width());
    info.height = static_cast<std::uint32_t>(camera.height());
    if (is_small) info.width = image_message.width, info.height = image_message.height;
    info.K = {camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1};
    if (i == contents.refocused_frame) info.K[0] += contents.refocused_by_px;
    info.distortion_model = contents.distortion_model;
    info.D = contents.distortion;
    if (contents.has_projection) {
      info.P = {camera.fx(), 0, camera.cx(), 0, 0, camera.fy(), camera.cy(), 0, 0, 0, 1, 0};
      info.K[0] *= 1.5;
    }
    write(bag, "/camera/rgb/camera_info", info);
    info.width = 1;  // of another camera
    write(bag, "/camera/depth/camera_info", info);
  }
}

class Bags : public testing::Test {
 protected:
  system_test::Outcome run(const std::string& more) const {
    return run_program("--quiet --backend none --out " + quoted(out) + " --bag " + quoted(bag) + ' ' + more);
  }
  void expect_run(const std::string& more = "") const {
    const auto outcome = run(more);
    ASSERT_EQ(outcome.status, 0) << outcome.error;
    EXPECT_EQ(report()["frames"], kFrames);
  }
  void expect_named_error(const std::string& more, const std::vector<std::string>& texts) const {
    expect_error("--quiet --out " + quoted(out) + " --bag " + quoted(bag) + ' ' + more, texts);
    EXPECT_EQ(files_in(out), std::vector<std::string>());
  }
  /// After a run, whose files go.
  void expect_named_fresh_error(const std::string& more, const std::vector<std::string>& texts) const {
    fs::remove_all(out);
    expect_named_error(more, texts);
  }
  nlohmann::json report() const { return nlohmann::json::parse(system_test::read_text(out / "report.json")); }
  std::string features() const { return system_test::read_text(out / "features.csv"); }

  system_test::TemporaryFolder folder;
  fs::path bag = folder / "small.bag", out = folder / "out";
};

TEST_F(Bags, GiveWhatTheSameFramesGiveAsFiles) {
  const fs::path sequence = folder / "sequence";
  system_test::write_small_sequence(sequence, kFrames);
  ASSERT_EQ(run_program("--quiet --backend none --out " + quoted(out) + " --tum " + quoted(sequence)).status, 0);
  const std::string expected = features();
  for (const char* encoding : {"bgr8", "rgb8"}) {
    Contents contents;
    contents.encoding = encoding;
    write_bag(bag, contents);
    expect_run("--camera " + quoted(sequence / "camera.yaml"));
    EXPECT_TRUE(features() == expected) << encoding;
  }
}

TEST_F(Bags, TakeTheCameraOfCameraInfoAndDepthInMetres) {
  Contents contents;
  contents.depth_encoding = "32FC1";
  write_bag(bag, contents);
  const auto outcome = run("");
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_EQ(report()["statuses"]["ok"], kFrames - 1);
  EXPECT_NE(outcome.out.find("Of the bag, images are those of /camera/rgb/image_color, depth is that of "
                             "/camera/depth/image, the camera that of /camera/rgb/camera_info."),
            std::string::npos)
      << outcome.out;
  contents.encoding = "mono8";
  write_bag(bag, contents);
  expect_run();
}

TEST_F(Bags, OfRectifiedImagesTakeTheCameraOfP) {
  Contents contents;
  write_bag(bag, contents);
  expect_run();
  const std::string expected = features();
  expect_named_fresh_error("--rectified", {"small.bag: camera_info: fx of P is 0, expected the projection matrix P"});
  contents.has_projection = true;
  contents.distortion_model = "rational_polynomial";
  contents.distortion = {0.1, 0, 0, 0, 0, 0.2, 0, 0};
  write_bag(bag, contents);
  expect_named_fresh_error("", {"small.bag: camera_info: distortion_model is rational_polynomial with coefficient 5",
                                "stillpoint_run: --rectified"});
  const auto outcome = run("--rectified");
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("the camera that of /camera/rgb/camera_info, rectified."), std::string::npos)
      << outcome.out;
  EXPECT_TRUE(features() == expected);
}

TEST_F(Bags, AskWhichTopicWhereMoreThanOneFits) {
  Contents contents;
  contents.has_second_image = true;
  write_bag(bag, contents);
  expect_named_error("", {"small.bag: found images (sensor_msgs/Image) on /camera/infra/image (bgr8), "
                          "/camera/rgb/image_color (bgr8), expected --image-topic with one of them"});
  expect_run("--image-topic /camera/rgb/image_color");
  fs::remove_all(out);
  expect_named_error("--image-topic /rgb", {"--image-topic: found /rgb, expected one of /camera/infra/image (bgr8), "
                                            "/camera/rgb/image_color (bgr8)"});
  expect_named_error("--image-topic /camera/infra/image",
                     {"found cameras (sensor_msgs/CameraInfo) on /camera/depth/camera_info, /camera/rgb/camera_info, "
                      "expected --camera-info-topic with one of them"});
  expect_run("--image-topic /camera/infra/image --camera-info-topic /camera/rgb/camera_info");
}

TEST_F(Bags, SayWhatIsNotInThem) {
  Contents contents;
  contents.has_depth = false;
  write_bag(bag, contents);
  expect_named_error("", {"small.bag: found no topic with depth (sensor_msgs/Image of 16UC1 or 32FC1)"});
  contents = {};
  contents.has_camera_info = false;
  write_bag(bag, contents);
  expect_named_error("", {"small.bag: found no topic with cameras (sensor_msgs/CameraInfo)"});
  contents = {};
  contents.depth_late_s = 100;
  write_bag(bag, contents);
  expect_named_error("", {"small.bag: found no frame: the last image and the depth nearest to it are 99.867 s apart, "
                          "expected 0.010 s at most"});
  contents = {};
  contents.encoding = "bayer_rggb8";
  write_bag(bag, contents);
  expect_named_error("", {"small.bag: encoding is 'bayer_rggb8'"});
  contents = {};
  contents.distortion_model = "double_sphere";
  contents.distortion = {0.1};
  write_bag(bag, contents);
  expect_named_error("", {"small.bag: camera_info: distortion_model is 'double_sphere'"});
}

TEST_F(Bags, BrokenFilesAreNamed) {
  expect_named_error("", {"small.bag: "});
  system_test::write_text(bag, "no bag");
  expect_named_error("", {"small.bag: "});
  write_bag(bag);
  fs::resize_file(bag, fs::file_size(bag) / 2);
  expect_named_error("", {"small.bag: "});
}

TEST_F(Bags, TopicsNeedABag) {
  expect_error("--demo --depth-topic /depth", {"--depth-topic: found without --bag, expected --bag with a file"});
  expect_error("--demo --rectified", {"--rectified: found without --bag, expected --bag with a file"});
  expect_error("--bag a.bag --camera c.yaml --rectified", {"--rectified: found with --camera, expected one of them"});
  expect_error("--bag a.bag --camera c.yaml --camera-info-topic /c",
               {"--camera-info-topic: found with --camera, expected one of them"});
}

TEST_F(Bags, ImagesWithoutDepthAreLeftOutAndCounted) {
  Contents contents;
  contents.depthless_frame = 2;
  write_bag(bag, contents);
  stillpoint_ros::RgbdBag reader(bag, {}, true);
  std::vector<double> stamps;
  while (const auto frame = reader.next()) {
    EXPECT_EQ(frame->image.stamp_s, frame->depth.stamp_s);
    EXPECT_EQ(frame->camera.width, 160);
    stamps.push_back(frame->image.stamp_s);
  }
  EXPECT_EQ(stamps.size(), static_cast<std::size_t>(kFrames - 1));
  EXPECT_EQ(reader.unpaired_images(), 1u);
  const auto outcome = run("");
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("1 image has no depth of its time and was left out."), std::string::npos) << outcome.out;
  EXPECT_EQ(report()["images_without_depth"], 1);
}

TEST_F(Bags, TheLastImageWithoutDepthIsCountedWhereTheRunGetsThere) {
  Contents contents;
  contents.depthless_frame = kFrames - 1;
  write_bag(bag, contents);
  ASSERT_EQ(run("").status, 0);
  EXPECT_EQ(report()["images_without_depth"], 1);
  ASSERT_EQ(run("--frames 2").status, 0);
  EXPECT_EQ(report()["images_without_depth"], 0);
}

TEST_F(Bags, ImagesOfAnotherSizeThanTheCameraAreAnError) {
  Contents contents;
  contents.small_frame = 2;
  write_bag(bag, contents);
  expect_named_error("", {"small.bag: image at ", " s: found 80 x 60 pixels, expected the camera's 160 x 120"});
  write_bag(bag);
  const fs::path camera = folder / "camera.yaml";
  system_test::write_text(camera,
                          "fx: 500\nfy: 500\ncx: 319.5\ncy: 239.5\nwidth: 640\nheight: 480\ndepth_factor: 1000\n");
  expect_named_error("--camera " + quoted(camera), {"found 160 x 120 pixels, expected the camera's 640 x 480"});
}

// Of 131.25 px, 1 is 40 / 131.25 = 0.305 px half-way to the border of 160; 0.1 is 0.03.
TEST_F(Bags, IntrinsicsThatChangeAreAnErrorUnlessByLessThanACornersNoise) {
  Contents contents;
  contents.refocused_frame = 2;
  contents.refocused_by_px = 0.1;
  write_bag(bag, contents);
  expect_run();
  contents.refocused_by_px = 1;
  write_bag(bag, contents);
  expect_named_fresh_error("", {"small.bag: camera_info at ", " s: found other intrinsics than the first ones"});
}

}  // namespace
}  // namespace bag_test
