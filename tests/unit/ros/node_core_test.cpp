// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A node without ROS: its answers are the filter's, and it says what it lacks. A scene of the library, 320 x 240
// pixels.

#include "stillpoint_ros/node_core.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"
#include "unit/error_of.hpp"

namespace stillpoint_ros::node_core_test {

using stillpoint::as_mat;

constexpr int kFrames = 10;
constexpr double kDepthUnit = 5000;

/// One frame as messages, which it owns.
struct Frame {
  cv::Mat bgr, depth;
  PairedFrame messages;

  RawImage raw(const cv::Mat& image, const std::string& encoding, double stamp_s) const {
    RawImage message;
    message.stamp_s = stamp_s;
    message.width = image.cols;
    message.height = image.rows;
    message.step_bytes = image.step[0];
    message.encoding = encoding;
    message.data = image.data;
    message.size_bytes = image.total() * image.elemSize();
    return message;
  }
};

const std::vector<Frame>& frames() {
  static const std::vector<Frame> all = [] {
    stillpoint::synthetic::SceneOptions options;
    options.frames = kFrames;
    options.width = 320;
    options.height = 240;
    stillpoint::SyntheticSequence sequence(stillpoint::synthetic::demo(options));
    const stillpoint::Camera& camera = sequence.camera();
    std::vector<Frame> rendered(kFrames);
    stillpoint::SyntheticFrame scene;
    for (int i = 0; i < kFrames; ++i) {
      sequence.render(i, scene);
      Frame& frame = rendered[static_cast<std::size_t>(i)];
      frame.bgr = as_mat(scene.colour.view()).clone();
      frame.depth = as_mat(scene.depth.view()).clone();
      frame.messages.image = frame.raw(frame.bgr, "bgr8", scene.timestamp_s);
      frame.messages.depth = frame.raw(frame.depth, "16UC1", scene.timestamp_s);
      frame.messages.camera.width = camera.width();
      frame.messages.camera.height = camera.height();
      frame.messages.camera.k = {camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1};
    }
    return rendered;
  }();
  return all;
}

stillpoint::Camera camera() { return camera_of(frames()[0].messages.camera); }

bool is_equal(const stillpoint::ImageView& a, const cv::Mat& b) {
  const cv::Mat found = as_mat(a);
  return found.size() == b.size() && found.type() == b.type() && cv::norm(found, b, cv::NORM_INF) == 0;
}
int dropped(const stillpoint::ImageView& mask) { return mask.width * mask.height - cv::countNonZero(as_mat(mask)); }

TEST(MaskSession, AnswersAsTheFilterDoes) {
  MaskSession session;
  session.options.depth_units_per_metre = kDepthUnit;
  stillpoint::FrameFilter<> filter(camera());
  const auto orb = cv::ORB::create(1000);
  int dropped_pixels = 0;
  for (const Frame& frame : frames()) {
    cv::Mat gray;
    cv::cvtColor(frame.bgr, gray, cv::COLOR_BGR2GRAY);
    std::vector<cv::KeyPoint> keypoints;
    orb->detect(gray, keypoints);
    const double time_s = frame.messages.image.stamp_s;
    const stillpoint::DepthView depth(frame.depth, kDepthUnit);
    const stillpoint::FrameResult& result = filter.filter_frame({gray, depth, time_s}, keypoints);
    stillpoint::ImageBuffer mask, masked;
    filter.predicted_keep_mask(time_s + 1e-4, 8, mask);
    stillpoint::masked_depth(depth, mask.view(), masked);

    const FrameAnswer& answer = session.process(frame.messages);
    EXPECT_EQ(answer.status, result.status());
    EXPECT_EQ(answer.features, keypoints.size());
    EXPECT_EQ(answer.kept, result.kept_count());
    EXPECT_TRUE(is_equal(answer.mask, as_mat(mask.view())));
    EXPECT_TRUE(is_equal(answer.mask_inverse, 255 - as_mat(mask.view())));
    EXPECT_TRUE(is_equal(answer.depth, as_mat(masked.view())));
    dropped_pixels += dropped(answer.mask);
  }
  EXPECT_GT(dropped_pixels, 1000) << "the scene has a mover, or this test shows nothing";
}

TEST(MaskSession, FollowsMoversWhereItIsAsked) {
  MaskSession with, without;
  with.options.depth_units_per_metre = without.options.depth_units_per_metre = kDepthUnit;
  with.options.follow_movers = true;
  for (const Frame& frame : frames()) {
    const FrameAnswer &answer = with.process(frame.messages), &masks = without.process(frame.messages);
    EXPECT_TRUE(masks.movers.empty());
    EXPECT_TRUE(is_equal(masks.mask, as_mat(answer.mask)));
    if (&frame != &frames().back()) continue;
    ASSERT_FALSE(answer.movers.empty());
    EXPECT_EQ(answer.movers[0].id, 1u);
    EXPECT_GT(answer.movers[0].centroid.z(), 0.5);
  }
}

TEST(MaskSession, EncodingsDoNotMatter) {
  MaskSession first, second;
  first.options.depth_units_per_metre = second.options.depth_units_per_metre = kDepthUnit;
  for (const Frame& frame : frames()) {
    Frame other = frame;
    cv::Mat rgb, metres(frame.depth.size(), CV_32FC1);
    cv::cvtColor(frame.bgr, rgb, cv::COLOR_BGR2RGB);
    const stillpoint::DepthView depth(frame.depth, kDepthUnit);
    for (int v = 0; v < metres.rows; ++v)
      for (int u = 0; u < metres.cols; ++u) metres.at<float>(v, u) = depth.metres(u, v);
    other.messages.image = frame.raw(rgb, "rgb8", frame.messages.image.stamp_s);
    other.messages.depth = frame.raw(metres, "32FC1", frame.messages.depth.stamp_s);
    const FrameAnswer& a = first.process(frame.messages);
    const FrameAnswer& b = second.process(other.messages);
    EXPECT_EQ(a.kept, b.kept);
    EXPECT_TRUE(is_equal(a.mask, as_mat(b.mask)));
    EXPECT_EQ(as_mat(b.depth).type(), CV_32FC1);
  }
}

TEST(MaskSession, KeepsEverythingWhereItCannotTell) {
  MaskSession session;
  session.options.depth_units_per_metre = kDepthUnit;
  const FrameAnswer& answer = session.process(frames()[0].messages);
  EXPECT_EQ(answer.status, stillpoint::Status::first_frame);
  EXPECT_EQ(dropped(answer.mask), 0);
  EXPECT_TRUE(is_equal(answer.depth, frames()[0].depth));
}

TEST(MaskSession, ABrokenMessageIsNamedAndTheNextIsJudged) {
  MaskSession session;
  session.options.depth_units_per_metre = kDepthUnit;
  session.process(frames()[0].messages);
  PairedFrame broken = frames()[1].messages;
  broken.depth.encoding = "rgb8";
  EXPECT_EQ(stillpoint::error_of([&] { session.process(broken); }),
            "depth: encoding is 'rgb8', expected 16UC1 (millimetres) or 32FC1 (metres)");
  broken = frames()[1].messages;
  broken.image.encoding = "yuv422";
  EXPECT_EQ(stillpoint::error_of([&] { session.process(broken); }).substr(0, 26), "image: encoding is 'yuv422");
  EXPECT_EQ(session.process(frames()[2].messages).status, stillpoint::Status::ok);
}

TEST(MaskSession, AnotherCameraBeginsAnew) {
  MaskSession session;
  session.options.depth_units_per_metre = kDepthUnit;
  session.process(frames()[0].messages);
  EXPECT_EQ(session.process(frames()[1].messages).status, stillpoint::Status::ok);
  PairedFrame other = frames()[2].messages;
  other.camera.k[0] += 1;
  const FrameAnswer& answer = session.process(other);
  EXPECT_EQ(answer.status, stillpoint::Status::first_frame);
  EXPECT_EQ(std::string(answer.hint), "camera_info is of another camera than before: the filter began anew.");
  EXPECT_EQ(session.filter.camera.fx(), other.camera.k[0]);
}

// A phone's focus, and a driver that fills a matrix nobody uses: the history fits.
TEST(MaskSession, ACalibrationThatChangesInItsLastDigitsIsTheSameCamera) {
  MaskSession session;
  session.options.depth_units_per_metre = kDepthUnit;
  for (std::size_t i = 0; i < 3; ++i) {
    PairedFrame frame = frames()[i].messages;
    frame.camera.k[0] += 1e-3 * static_cast<double>(i);
    frame.camera.p[3] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(session.process(frame).status, i == 0 ? stillpoint::Status::first_frame : stillpoint::Status::ok) << i;
  }
}

TEST(MaskSession, RectifiedImagesHaveTheCameraOfP) {
  MaskSession session;
  session.options.depth_units_per_metre = kDepthUnit;
  session.options.rectified = true;
  PairedFrame frame = frames()[0].messages;
  const auto k = frame.camera.k;
  frame.camera.p = {k[0], 0, k[2], 0, 0, k[4], k[5], 0, 0, 0, 1, 0};
  frame.camera.k[0] += 50;
  frame.camera.distortion_model = "rational_polynomial";
  frame.camera.d = {.1, 0, 0, 0, 0, .2, 0, 0};
  EXPECT_EQ(session.process(frame).status, stillpoint::Status::first_frame);
  EXPECT_EQ(session.filter.camera.fx(), k[0]);
  frame.image.stamp_s += 0.03;
  frame.camera.p[0] += 1;
  EXPECT_EQ(session.process(frame).status, stillpoint::Status::first_frame) << "another camera";
}

struct Given {
  std::map<std::string, double> numbers;

  template <class Value>
  Value get(const std::string& name, const Value& value) const {
    const auto found = numbers.find(name);
    if constexpr (std::is_arithmetic_v<Value>)
      if (found != numbers.end()) return static_cast<Value>(found->second);
    return value;
  }
};

class NodeCoreTest : public testing::Test {
 protected:
  void start(const std::map<std::string, double>& numbers = {}) {
    Given given{numbers};
    given.numbers["depth_units_per_metre"] = kDepthUnit;
    core.start(given);
  }
  void send(const Frame& frame) {
    core.add_depth(frame.messages.depth);
    core.add_camera_info(frame.messages.camera);
    core.add_image(frame.messages.image);
  }
  /// Until so many answers have come and were counted.
  bool wait_for(std::size_t count) {
    std::unique_lock<std::mutex> lock(mutex);
    return changed.wait_for(lock, std::chrono::seconds(30), [&] { return stamps.size() >= count; });
  }
  static std::string value(const Report& report, const std::string& key) {
    for (const auto& [name, text] : report.values)
      if (name == key) return text;
    return "none";
  }
  /// The first report that misses something.
  Report first_refusal() {
    Report report;
    for (int attempt = 0; attempt < 1000 && report.missing.empty(); ++attempt) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      report = core.report();
    }
    return report;
  }
  /// What reports say of frames until so many were counted, the last of them just after it was published.
  struct Counts {
    int frames = 0, judged = 0;
    Report last;
  };
  Counts count_frames(int count) {
    Counts counts;
    for (int attempt = 0; attempt < 1000 && counts.frames < count; ++attempt) {
      const Report report = core.report();
      const int frames = std::stoi(value(report, "frames"));
      if (frames == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (frames > 0) counts.last = report;
      counts.frames += frames;
      counts.judged += std::stoi(value(report, "frames judged"));
    }
    return counts;
  }

  std::mutex mutex;
  std::condition_variable changed;
  std::vector<double> stamps;
  std::vector<int> dropped_pixels;
  std::vector<std::size_t> objects;
  NodeCore core{{"/rgb", "/depth", "/info"}, [this](const PairedFrame& frame, const FrameAnswer& answer) {
                  const std::lock_guard<std::mutex> lock(mutex);
                  stamps.push_back(frame.image.stamp_s);
                  dropped_pixels.push_back(dropped(answer.mask));
                  objects.push_back(answer.objects);
                  changed.notify_all();
                }};
};

TEST_F(NodeCoreTest, AnswersEachFrameAndReports) {
  start();
  for (std::size_t i = 0; i < 4; ++i) {
    send(frames()[i]);
    ASSERT_TRUE(wait_for(i + 1));
    EXPECT_EQ(stamps[i], frames()[i].messages.image.stamp_s);
  }
  EXPECT_GT(dropped_pixels.back(), 0);
  const Counts counts = count_frames(4);
  EXPECT_EQ(counts.frames, 4);
  EXPECT_EQ(counts.judged, 3);
  EXPECT_EQ(counts.last.level, Report::ok);
  EXPECT_EQ(counts.last.message, "frames are judged");
  EXPECT_TRUE(counts.last.missing.empty());
  EXPECT_EQ(value(counts.last, "last status"), "ok");
  EXPECT_EQ(value(core.report(), "frames"), "0") << "each frame is reported once";
}

// The next report comes frames later, and the one behind it no longer speaks of it.
TEST_F(NodeCoreTest, ReportsAHintOfOneFrameOnce) {
  start();
  for (std::size_t i = 0; i < 4; ++i) {
    Frame frame = frames()[i];
    frame.messages.camera.stamp_s = frame.messages.image.stamp_s;
    if (i >= 1) frame.messages.camera.k[0] += 1;
    send(frame);
    ASSERT_TRUE(wait_for(i + 1));
  }
  const std::string hint = "camera_info is of another camera than before: the filter began anew.";
  std::string told;
  int frames_told = 0;
  for (int attempt = 0; attempt < 1000 && frames_told < 4; ++attempt) {
    const Report report = core.report();
    frames_told += std::stoi(value(report, "frames"));
    if (report.hint.empty()) continue;
    told += report.hint;
    EXPECT_EQ(report.level, Report::warn);
    EXPECT_EQ(report.message, hint);
  }
  EXPECT_EQ(told, hint);
  EXPECT_TRUE(core.report().hint.empty());
}

TEST_F(NodeCoreTest, SaysWhatIsMissing) {
  start();
  core.add_image(frames()[0].messages.image);
  const Report report = core.report();
  EXPECT_EQ(report.level, Report::error);
  EXPECT_EQ(report.missing, (std::vector<std::string>{"no depth on /depth yet", "no camera_info on /info yet"}));
  EXPECT_EQ(report.message, report.missing.front());
}

TEST_F(NodeCoreTest, SaysWhyAMessageIsRefused) {
  start();
  Frame frame = frames()[0];
  frame.messages.image.encoding = "yuv422";
  send(frame);
  const Report report = first_refusal();
  ASSERT_EQ(report.missing.size(), 1u);
  EXPECT_EQ(report.missing[0].substr(0, 26), "image: encoding is 'yuv422");
}

TEST_F(NodeCoreTest, SaysWhatOpenCvRefuses) {
  start();
  Frame row = frames()[0];  // an image pyramid of one row has a level without pixels
  row.bgr = row.bgr.row(0).clone();
  row.depth = row.depth.row(0).clone();
  row.messages.image = row.raw(row.bgr, "bgr8", 1.0);
  row.messages.depth = row.raw(row.depth, "16UC1", 1.0);
  row.messages.camera.height = 1;
  row.messages.camera.k[5] = 0;
  send(row);
  const Report report = first_refusal();
  ASSERT_EQ(report.missing.size(), 1u);
  EXPECT_NE(report.missing[0].find("OpenCV"), std::string::npos) << report.missing[0];
  send(frames()[1]);
  EXPECT_TRUE(wait_for(1)) << "the next frame is judged";
}

TEST_F(NodeCoreTest, DetectionsReachThePrior) {
  start();
  stillpoint::Detection person;
  person.box = {100, 60, 80, 120};
  person.mobility = stillpoint::Mobility::dynamic;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0) core.add_detections(frames()[i].messages.image.stamp_s, {person});
    send(frames()[i]);
    ASSERT_TRUE(wait_for(i + 1));
  }
  EXPECT_EQ(objects, (std::vector<std::size_t>{0, 1, 1}));
}

TEST_F(NodeCoreTest, DetectionsWaitForTheirFrameInALongQueue) {
  start({{"longest_queue", 10}});
  stillpoint::Detection person;
  person.box = {100, 60, 80, 120};
  person.mobility = stillpoint::Mobility::dynamic;
  {
    const std::lock_guard<std::mutex> lock(mutex);  // the worker waits where it publishes
    for (std::size_t i = 0; i < 4; ++i) send(frames()[i]);
    core.add_detections(frames()[3].messages.image.stamp_s, {person});
  }
  ASSERT_TRUE(wait_for(4));
  EXPECT_EQ(objects, (std::vector<std::size_t>{0, 0, 0, 1}));
}

TEST_F(NodeCoreTest, AsManyDetectionsWaitAsFrames) {
  start({{"longest_queue", 20}});
  for (int i = 0; i < 30; ++i) core.add_detections(100 + i, {});
  EXPECT_EQ(value(core.report(), "detections waiting"), "20");
  NodeCore usual({"", "", ""}, [](const PairedFrame&, const FrameAnswer&) {});
  Given given;
  usual.start(given);
  for (int i = 0; i < 30; ++i) usual.add_detections(100 + i, {});
  EXPECT_EQ(value(usual.report(), "detections waiting"), "16");
}

TEST_F(NodeCoreTest, DetectionsOfARecordingThatBeganAnewAreDropped) {
  start({{"longest_queue", 10}});
  const auto send_at = [&](std::size_t i, double stamp_s) {
    Frame frame = frames()[i];
    frame.messages.image.stamp_s = frame.messages.depth.stamp_s = stamp_s;
    send(frame);
  };
  send_at(0, 10.0);
  send_at(1, 10.1);
  core.add_detections(10.3, {});
  ASSERT_TRUE(wait_for(2));
  EXPECT_EQ(value(core.report(), "detections waiting"), "1");
  send_at(0, 5.0);
  core.add_detections(5.2, {});
  ASSERT_TRUE(wait_for(3));
  EXPECT_EQ(value(core.report(), "detections waiting"), "1") << "that of the new recording";
  send_at(1, 5.1);
  send_at(2, 5.2);
  ASSERT_TRUE(wait_for(5));
  EXPECT_EQ(value(core.report(), "detections waiting"), "0");
}

TEST_F(NodeCoreTest, DetectionsOfTheNewRecordingWaitForTheOldFrames) {
  start({{"longest_queue", 10}});
  stillpoint::Detection person;
  person.box = {100, 60, 80, 120};
  person.mobility = stillpoint::Mobility::dynamic;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    for (const auto& [i, stamp_s] : {std::pair<std::size_t, double>{0, 10.0}, {1, 10.1}, {0, 5.0}, {1, 5.1}}) {
      Frame frame = frames()[i];
      frame.messages.image.stamp_s = frame.messages.depth.stamp_s = stamp_s;
      send(frame);
    }
    core.add_detections(5.1, {person});
  }
  ASSERT_TRUE(wait_for(4));
  EXPECT_EQ(objects, (std::vector<std::size_t>{0, 0, 0, 1}));
}

TEST_F(NodeCoreTest, ParametersAreTheOptions) {
  Given given;
  const std::vector<std::string> names = core.start(given);
  for (const char* name :
       {"features", "margin_px", "depth_units_per_metre", "rectified", "sync_tolerance_s", "longest_queue",
        "gate.false_positive_rate", "keep_floor.fewest_features", "depth_noise.model"})
    EXPECT_EQ(unknown_parameter({name}, names), "");
  NodeCore other({"", "", ""}, [](const PairedFrame&, const FrameAnswer&) {});
  Given wrong{{{"gate.false_positive_rate", 5}}};
  EXPECT_EQ(stillpoint::error_of([&] { other.start(wrong); }),
            "parameter gate.false_positive_rate is 5, expected a number from 0.000001 to 0.5");
}

TEST_F(NodeCoreTest, ALaterToleranceIsUsed) {
  start({{"sync_tolerance_s", 0.05}});
  Frame frame = frames()[0];
  frame.messages.depth.stamp_s += 0.04;
  send(frame);
  EXPECT_TRUE(wait_for(1));
}

}  // namespace stillpoint_ros::node_core_test
