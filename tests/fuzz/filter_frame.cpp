// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The default filter, with movers, on a sequence of small frames: any keypoints, depths, times, boxes, poses, cameras,
// in any order. One program with shim.cpp and the shim itself, compiled as one file: the filter takes long to compile.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>
#include <type_traits>
#include <vector>

#include "bytes.hpp"
#include "frame_images.hpp"
#include "judged_frames.hpp"
#include "shim.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies/default_policies.hpp"
#include "stillpoint/policies/with_movers.hpp"

namespace fuzz {
namespace {

using namespace stillpoint;

using Filter = FrameFilter<WithMovers<>>;

Camera make_camera(Bytes& bytes) {
  const int width = bytes.integer(1, 48), height = bytes.integer(1, 48);
  const double f = bytes.flag() ? 40.0 : 0.5;
  return {f, f, 0.5 * width, 0.5 * height, width, height};
}

/// A pose near the identity, of which some numbers may be anything.
Pose make_pose(Bytes& bytes) {
  Pose pose = Pose::Identity();
  for (int i = 0; i < 3; ++i) pose.translation()(i) = bytes.number(-0.2, 0.2);
  pose.linear() = rotation_from_vector({0.01 * bytes.integer(-9, 9), 0.0, 0.0});
  if (bytes.integer(0, 3) == 0) pose.linear()(bytes.byte() % 3, bytes.byte() % 3) = bytes.number(-1, 1);
  return pose;
}

void set_boxes(Bytes& bytes, double timestamp_s, Filter& filter) {
  std::vector<Detection> detections(static_cast<std::size_t>(bytes.integer(0, 4)));
  for (Detection& detection : detections) {
    detection.box = {bytes.single(-5, 40), bytes.single(-5, 40), bytes.single(-1, 40), bytes.single(-1, 40)};
    detection.mobility = static_cast<Mobility>(bytes.integer(0, 3));
    detection.confidence = bytes.single(0, 1);
    if (!bytes.flag()) continue;
    BoxMask mask{bytes.integer(-1, 5), bytes.integer(-1, 5), {}};
    mask.inside.assign(static_cast<std::size_t>(bytes.integer(0, 25)), 1);
    detection.mask = std::make_shared<const BoxMask>(mask);
  }
  if (bytes.flag())
    filter.prior.detected(bytes.flag() ? timestamp_s : bytes.number(0, 2), detections);
  else
    filter.prior.detections = detections;
}

JudgedFrames frames_of_filter("the filter");

/// @param depth_factor  units per metre of a 16-bit depth
/// @return              how many keypoints it had
std::size_t filter_one(Bytes& bytes, double timestamp_s, double depth_factor, Filter& filter) {
  int width = filter.camera.width(), height = filter.camera.height();
  if (bytes.integer(0, 15) == 0) width = bytes.integer(1, 48);
  const cv::Mat gray = make_gray(bytes, width, height), depth = make_depth(bytes, width, height);
  std::vector<Vector2f> keypoints;
  const int step = bytes.integer(2, 12);
  for (int v = 0; v < height; v += step)
    for (int u = 0; u < width; u += step) keypoints.emplace_back(static_cast<float>(u), static_cast<float>(v));
  for (int i = bytes.integer(0, 9); i > 0; --i) keypoints.emplace_back(bytes.single(-2, 50), bytes.single(-2, 50));
  const FrameResult& result =
      filter.filter_frame(FrameView(gray, DepthView(depth, depth_factor), timestamp_s), keypoints);

  frames_of_filter.count(judged(result.status()));
  require(result.size() == keypoints.size());
  require(result.motion().current_from_reference.matrix().allFinite());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    kept += result.keep()[i];
    require(std::isfinite(result.label(i).log_odds) && std::isfinite(result.depth_m(i)));
  }
  require(kept == result.kept_count());
  ImageBuffer mask;
  for (const Mover& mover : result.movers()) {
    require(mover.centroid.allFinite() && mover.velocity.allFinite() && mover.velocity_covariance.allFinite());
    require(mover.current_from_reference.matrix().allFinite() && mover.covariance.allFinite());
    for (const std::uint32_t feature : result.features(mover)) require(result.mover(feature) == &mover);
    result.mask(mover, mask, 5);
  }
  result.mask(mask, 5);
  return keypoints.size();
}

/// Draws one option in eight within its range: an end, or anything between, small values more often.
class DrawOptions {
 public:
  explicit DrawOptions(Bytes& bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(const char*, T& value, const OptionRange& range) {
    const int draw = bytes_.byte();
    if (draw < 224) return;  // what lies behind the last byte is 0: the rest keeps its default
    const double share = std::pow(bytes_.byte() / 255.0, 6.0);
    const double number = draw < 8    ? range.least
                          : draw < 10 ? range.most
                                      : range.least + share * (range.most - range.least);
    value = static_cast<T>(number);
  }
  template <class T>
  void operator()(const char*, T& value) {
    if constexpr (std::is_same_v<T, bool>)
      value = bytes_.byte() >= 224 ? !value : value;
    else if constexpr (has_options<T, DrawOptions>::value)
      each_option(value, *this);
  }
  template <class T>
  void seed(const char*, T& value) {
    value = static_cast<T>(bytes_.byte());
  }
  template <class T, class... Words>
  void choice(const char*, T& value, Words...) {
    if (bytes_.byte() >= 224) value = static_cast<T>(bytes_.integer(0, static_cast<int>(sizeof...(Words)) - 1));
  }

 private:
  Bytes& bytes_;
};

/// Any options within their ranges.
void set_options(Bytes& bytes, Filter& filter) {
  DrawOptions draw(bytes);
  each_option(filter, draw);
  require(filter.options_error().empty());
}

}  // namespace

void run_filter(Bytes& bytes) {
  constexpr int kMostFrames = 12;
  Filter filter(make_camera(bytes));
  ImageBuffer mask;
  double timestamp_s = 1.0;
  std::vector<std::uint8_t> is_dynamic;
  for (int frame = 0; frame < kMostFrames && !bytes.empty(); ++frame) {
    const int before = bytes.byte();
    double depth_factor = 5000.0;
    if (before < 16) filter.camera = make_camera(bytes);
    if (before >= 16 && before < 32) set_options(bytes, filter);
    if (before >= 32 && before < 48) filter.expect_motion(make_pose(bytes));
    if (before >= 48 && before < 64) filter.feedback(make_pose(bytes));
    if (before >= 64 && before < 96) set_boxes(bytes, timestamp_s, filter);
    if (before >= 96 && before < 112) filter.predicted_keep_mask(bytes.number(0, 2), bytes.integer(-3, 60), mask);
    if (before >= 112 && before < 120) filter.reset();
    if (before >= 120 && before < 126) depth_factor = bytes.number(-1, 6000);
    if (before >= 126 && before < 134) {
      std::generate(is_dynamic.begin(), is_dynamic.end(), [&] { return static_cast<std::uint8_t>(bytes.flag()); });
      filter.expect_dynamic(is_dynamic);
    }
    timestamp_s = before < 248 ? timestamp_s + 1.0 / 32 : bytes.number(0, 3);
    is_dynamic.resize(filter_one(bytes, timestamp_s, depth_factor, filter));
  }
}

}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cv::setNumThreads(1);
  fuzz::Bytes bytes(data, size);
  bytes.flag() ? fuzz::run_shim(bytes) : fuzz::run_filter(bytes);
  return 0;
}
