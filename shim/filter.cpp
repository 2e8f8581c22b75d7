// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The library's side of the border: plain data becomes the library's types, exceptions become messages and statuses.

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <stillpoint/core/plausible_motion.hpp>
#include <stillpoint/detectors/mobility_table.hpp>
#include <stillpoint/prior/propagated_prior.hpp>
#include <stillpoint/stillpoint.hpp>
#include <stillpoint_shim/types.hpp>
#include <string>
#include <vector>

namespace stillpoint_shim {
namespace {

void require(bool holds, const char* name, double found, const char* expected) {
  if (!holds)
    throw stillpoint::Error(std::string(name) + " is " + stillpoint::option_text(found) + ", expected " + expected);
}

stillpoint::AnyDistortion distortion_of(const Camera& camera) {
  const double* const k = camera.distortion;
  const int lens = static_cast<int>(camera.lens);
  require(lens >= 0 && lens <= 2, "camera: lens", lens, "one of stillpoint_shim::Lens");
  if (camera.lens == Lens::brown_conrady) return {stillpoint::BrownConrady{k[0], k[1], k[2], k[3], k[4]}};
  require(k[4] == 0, "camera: distortion[4]", k[4], "0: only brown_conrady has five coefficients");
  if (camera.lens == Lens::fisheye) return {stillpoint::EquidistantFisheye{k[0], k[1], k[2], k[3]}};
  for (int i = 0; i < 4; ++i) require(k[i] == 0, "camera: distortion", k[i], "zeros for a pinhole; or another lens");
  return {};
}

stillpoint::AnyDepthNoise depth_noise_of(double fx_px, const Settings& settings) {
  const int model = static_cast<int>(settings.depth_noise);
  require(model >= 0 && model <= 2, "settings: depth_noise", model, "one of stillpoint_shim::DepthNoise");
  if (settings.depth_noise == DepthNoise::kinect) return stillpoint::KinectNoise{};
  if (settings.depth_noise == DepthNoise::time_of_flight) return stillpoint::TimeOfFlightNoise{};
  return stillpoint::StereoNoise{fx_px, settings.stereo_baseline_m, settings.stereo_disparity_sigma_px};
}

stillpoint::ImageView view(const detail::Image& image) {
  if (image.data == nullptr) return {};
  return {image.data, image.columns, image.rows, image.stride_bytes,
          stillpoint::image_traits<cv::Mat>::format(image.type)};
}

/// Nothing where the matrix, 4 x 4 row by row, is no rigid motion.
std::optional<stillpoint::Pose> rigid_motion(const double* rows) {
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(rows);
  constexpr double kRounding = 1e-3;  // of poses that a host keeps in single precision
  stillpoint::Pose pose = stillpoint::Pose::Identity();
  pose.linear() = matrix.topLeftCorner<3, 3>();
  pose.translation() = matrix.topRightCorner<3, 1>();
  if (!matrix.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), kRounding) || !stillpoint::is_rigid(pose))
    return std::nullopt;
  return stillpoint::orthonormalized(pose);
}

stillpoint::Mobility mobility(Mobility mobility) {
  switch (mobility) {
    case Mobility::fixed: return stillpoint::Mobility::fixed;
    case Mobility::movable: return stillpoint::Mobility::movable;
    case Mobility::dynamic: return stillpoint::Mobility::dynamic;
    default: return stillpoint::Mobility::unknown;
  }
}

}  // namespace

namespace detail {

class Engine {
 public:
  Engine(const Camera& camera, const Settings& settings)
      : filter_({camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height, distortion_of(camera)}) {
    change_settings(settings);
  }

  /// Changes all of them or, where it throws, none.
  void change_settings(const Settings& settings) {
    const double factor = settings.depth_factor;
    require(factor == 0 || stillpoint::DepthView::is_unit(factor), "settings: depth_factor", factor,
            "0.001 to 1000000 units per metre: 1000 for millimetres, 5000 for TUM's files; 0 without 16-bit depth");
    require(settings.fewest_features >= 0, "settings: fewest_features", settings.fewest_features, "0 or more");
    const stillpoint::AnyDepthNoise noise_before = filter_.depth_noise;
    const auto gate_before = filter_.gate.options;
    const auto floor_before = filter_.keep_floor.options;
    filter_.depth_noise = depth_noise_of(filter_.camera.fx(), settings);
    filter_.gate.options.false_positive_rate = settings.false_positive_rate;
    filter_.keep_floor.options.fewest_features = static_cast<std::size_t>(settings.fewest_features);
    const std::string error = filter_.options_error();  // by the library's own ranges and names
    if (!error.empty()) {
      filter_.depth_noise = noise_before;
      filter_.gate.options = gate_before;
      filter_.keep_floor.options = floor_before;
      throw stillpoint::Error("settings: " + error);
    }
    depth_factor_ = factor;
  }

  const stillpoint::FrameResult& filter_frame(const Image& image, const Image& depth, double timestamp_s,
                                              const Points& points) {
    pixels_.resize(points.count);
    const char* next = static_cast<const char*>(points.data);
    for (stillpoint::Vector2f& pixel : pixels_) {
      std::memcpy(pixel.data(), next, 2 * sizeof(float));
      next += points.stride_bytes;
    }
    result_ = nullptr;  // until there is one of this frame
    result_ = &filter_.filter_frame({view(image), {view(depth), depth_factor_}, timestamp_s}, pixels_);
    return *result_;
  }

  void copy_weights(float* weights, std::size_t size) const {
    std::vector<float> of_feature(size, 1.0f);
    if (result_ != nullptr && result_->size() == size) stillpoint::weights(*result_, of_feature);
    std::copy(of_feature.begin(), of_feature.end(), weights);
  }

  void paint_mask(int radius_px, const Pixels& pixels) {
    if (result_ == nullptr) return fill(pixels);
    result_->mask(mask_, std::max(radius_px, 0));
    copy_mask(pixels);
  }

  void paint_predicted_keep_mask(double timestamp_s, int margin_px, const Pixels& pixels) {
    filter_.predicted_keep_mask(timestamp_s, std::max(margin_px, 0), mask_);
    copy_mask(pixels);
  }

  /// All is kept.
  void fill(const Pixels& pixels) const noexcept {
    for (int v = 0; v < filter_.camera.height(); ++v)
      std::memset(pixels.data + static_cast<std::size_t>(v) * pixels.stride_bytes, 255, width());
  }

  void set_boxes(const Box* boxes, std::size_t count, const double* timestamp_s) {
    std::vector<stillpoint::Detection> detections(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Box& box = boxes[i];
      detections[i].box = {box.x, box.y, box.width, box.height};
      detections[i].mobility = mobility(box.mobility);
      detections[i].confidence = box.confidence;
    }
    if (timestamp_s != nullptr)
      filter_.prior.detected(*timestamp_s, detections);
    else
      filter_.prior.detections = detections;
  }

  bool feedback(const double* world_from_camera) {
    const std::optional<stillpoint::Pose> pose = rigid_motion(world_from_camera);
    if (pose) filter_.feedback(*pose);
    return pose.has_value();
  }

  bool expect_motion(const double* current_from_reference) {
    const std::optional<stillpoint::Pose> motion = rigid_motion(current_from_reference);
    const bool is_taken = motion && stillpoint::is_plausible_motion(*motion);
    if (is_taken) filter_.expect_motion(*motion);
    return is_taken;
  }

  void reset() {
    filter_.reset();
    result_ = nullptr;
  }

 private:
  std::size_t width() const noexcept { return static_cast<std::size_t>(filter_.camera.width()); }

  void copy_mask(const Pixels& pixels) {
    for (int v = 0; v < filter_.camera.height(); ++v)
      std::memcpy(pixels.data + static_cast<std::size_t>(v) * pixels.stride_bytes, mask_.row<std::uint8_t>(v), width());
  }

  stillpoint::FrameFilter<> filter_;
  double depth_factor_ = 0;  // 0: not said
  std::vector<stillpoint::Vector2f> pixels_;
  stillpoint::ImageBuffer mask_;
  const stillpoint::FrameResult* result_ = nullptr;  // the filter's, of the last frame
};

Engine* create(const Camera& camera, const Settings& settings, char* message, std::size_t message_size) noexcept try {
  return new Engine(camera, settings);
} catch (const std::exception& error) {
  std::snprintf(message, message_size, "stillpoint: %s", error.what());
  return nullptr;
}

void destroy(Engine* engine) noexcept { delete engine; }

bool change_settings(Engine& engine, const Settings& settings, char* message, std::size_t message_size) noexcept try {
  engine.change_settings(settings);
  return true;
} catch (const std::exception& error) {
  std::snprintf(message, message_size, "stillpoint: %s", error.what());
  return false;
}

// What can be thrown from here on is std::bad_alloc. A frame then keeps everything and the filter begins anew.
Answer filter_frame(Engine& engine, const Image& image, const Image& depth, double timestamp_s, const Points& points,
                    unsigned char* keep) noexcept try {
  const stillpoint::FrameResult& result = engine.filter_frame(image, depth, timestamp_s, points);
  std::copy(result.keep().begin(), result.keep().end(), keep);
  const bool lacks_unit = result.status() == stillpoint::Status::depth_unit_missing;
  return {stillpoint::to_string(result.status()),
          lacks_unit ? "16-bit depth needs Settings::depth_factor: 1000 for millimetres, 5000 for TUM's files."
                     : result.hint(),
          stillpoint::judged(result.status()), result.warnings().has(stillpoint::Warning::keep_floor)};
} catch (...) {
  std::fill_n(keep, points.count, static_cast<unsigned char>(1));
  reset(engine);
  return {"failed", "", false, false};
}

void copy_weights(const Engine& engine, float* weights, std::size_t size) noexcept try {
  engine.copy_weights(weights, size);
} catch (...) {
  std::fill_n(weights, size, 1.0f);
}

void paint_mask(Engine& engine, int radius_px, const Pixels& pixels) noexcept try {
  engine.paint_mask(radius_px, pixels);
} catch (...) {
  engine.fill(pixels);
}

void paint_predicted_keep_mask(Engine& engine, double timestamp_s, int margin_px, const Pixels& pixels) noexcept try {
  engine.paint_predicted_keep_mask(timestamp_s, margin_px, pixels);
} catch (...) {
  engine.fill(pixels);
}

void set_boxes(Engine& engine, const Box* boxes, std::size_t count, const double* timestamp_s) noexcept try {
  engine.set_boxes(boxes, count, timestamp_s);
} catch (...) {  // no boxes, no harm: the prior only shifts odds
}

bool feedback(Engine& engine, const double* world_from_camera) noexcept { return engine.feedback(world_from_camera); }

bool expect_motion(Engine& engine, const double* current_from_reference) noexcept {
  return engine.expect_motion(current_from_reference);
}

void reset(Engine& engine) noexcept { engine.reset(); }

Mobility mobility_of(const char* class_name) noexcept try {
  switch (stillpoint::MobilityTable()[class_name]) {
    case stillpoint::Mobility::fixed: return Mobility::fixed;
    case stillpoint::Mobility::movable: return Mobility::movable;
    case stillpoint::Mobility::dynamic: return Mobility::dynamic;
    default: return Mobility::unknown;
  }
} catch (...) {
  return Mobility::unknown;
}

}  // namespace detail
}  // namespace stillpoint_shim
