// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A detection that is carried from frame to frame by the motion of the features on it.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/prior/image_motion.hpp"

namespace stillpoint {

/// Area that two boxes share over the area that they cover together, 0 to 1.
inline float intersection_over_union(const Box& a, const Box& b) noexcept {
  const float width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const float height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  if (!(width > 0 && height > 0)) return 0.0f;
  return width * height / (a.width * a.height + b.width * b.height - width * height);
}

/// One object that a detector has seen, where it is in the frame that came last. Each further frame first predicts
/// (before its features are known), then corrects.
class CarriedDetection {
 public:
  Detection detection;  ///< as it is in the last frame
  double seen_s = 0.0;  ///< time of the last frame in which the detector saw it
  int missed = 0;       ///< answers since then in which it was not

  CarriedDetection(const Detection& seen, double timestamp_s) : detection(seen), seen_s(timestamp_s) {}

  /// Its own speed in the image, beyond what the camera's motion gives a static object; pixels per second.
  const Vector2f& own_velocity_px_s() const noexcept { return own_px_s_; }

  bool has_depth_range() const noexcept { return std::isfinite(detection.farthest_m); }
  /// Of the object's middle, metres; infinity where it is not known.
  double depth_m() const noexcept { return 0.5 * (detection.nearest_m + detection.farthest_m); }

  /// Constant velocity in the image, for the time that has passed.
  void predict(const ImageMotion& image) {
    predicted_ = true;
    step_ = image_px_s_ * static_cast<float>(image.elapsed_s);
    move(step_, 1.0f, image);
  }

  /// Puts the step right by the features on the object; where these are too few, by the camera's motion and the
  /// object's own velocity. Where it was seen in this frame, learns its velocity and leaves it where it is.
  /// @param fewest_features  below it their median is not taken for the object's
  void correct(const ImageMotion& image, std::size_t fewest_features, Workspace& workspace) {
    if (!(image.elapsed_s > 0)) return;
    const auto elapsed_s = static_cast<float>(image.elapsed_s);
    const float known = std::min(elapsed_s / kSurely_s, 1.0f);  // time stamps next to each other tell no velocity
    const Vector2f from = centre() - (predicted_ ? step_ : image_px_s_ * elapsed_s);
    Vector2f static_step = Vector2f::Zero();
    if (image.knows_camera()) static_step = image.static_step(from, depth_m());
    Step step{static_step + own_px_s_ * elapsed_s, 1.0f};
    if (const std::optional<Step> measured = step_of_features(image, fewest_features, workspace)) {
      step = *measured;
      const Vector2f own = (step.displacement - static_step) / elapsed_s;
      if (image.knows_camera()) own_px_s_ += (is_followed_ ? 0.5f * known : known) * (own - own_px_s_);
      is_followed_ = true;
    } else if (!image.knows_camera()) {
      return;
    }
    image_px_s_ += known * (step.displacement / elapsed_s - image_px_s_);
    if (predicted_) move(step.displacement - step_, step.scale, image);
  }

  /// The detector has seen it again.
  /// @param seen  already carried to the last frame, if the answer was late
  void refresh(const CarriedDetection& seen) {
    const double unseen_s = seen.seen_s - seen_s;
    const Vector2f moved = seen.centre() - centre();
    detection = seen.detection;
    seen_s = seen.seen_s;
    missed = 0;
    predicted_ = seen.predicted_;
    step_ = seen.step_;
    if (seen.is_followed_) {
      own_px_s_ = seen.own_px_s_;
      image_px_s_ = seen.image_px_s_;
    } else if (!is_followed_ && unseen_s > 0) {  // nothing but the boxes tells its velocity
      own_px_s_ += moved / static_cast<float>(unseen_s);
      image_px_s_ += moved / static_cast<float>(unseen_s);
    }
    is_followed_ = seen.is_followed_;
  }

  /// The same, less certain: a box that is larger by `growth` of its size on each side.
  Detection grown(float growth, float confidence_factor) const {
    Detection result = detection;
    Box& box = result.box;
    box = {box.x - growth * box.width, box.y - growth * box.height, box.width * (1 + 2 * growth),
           box.height * (1 + 2 * growth)};
    result.confidence *= confidence_factor;
    return result;
  }

  bool is_in(const ImageMotion& image) const noexcept {
    const Box& box = detection.box;
    return box.x + box.width > 0 && box.y + box.height > 0 && box.x < static_cast<float>(image.width) &&
           box.y < static_cast<float>(image.height);
  }

 private:
  static constexpr float kSurely_s = 0.02f;  // a step of so long tells a velocity

  struct Step {
    Vector2f displacement;
    float scale;
  };

  Vector2f centre() const noexcept {
    const Box& box = detection.box;
    return {box.x + 0.5f * box.width, box.y + 0.5f * box.height};
  }

  /// A feature of the object: in the box, and where the object's depth is known, of that depth.
  bool holds(const FeatureStep& step, const ImageMotion& image) const noexcept {
    return detection.holds(step.to, static_cast<double>(step.to_depth_m)) &&
           (!has_depth_range() || !image.has_depths || step.to_depth_m > 0);
  }

  /// Medians: limbs swing about the trunk, and some features are not the object's. What comes nearer by a share of its
  /// depth grows by that share.
  std::optional<Step> step_of_features(const ImageMotion& image, std::size_t fewest, Workspace& workspace) const {
    const Workspace::Scope scope(workspace);
    const span<float> x = workspace.take<float>(image.steps.size());
    const span<float> y = workspace.take<float>(image.steps.size());
    const span<float> nearing = workspace.take<float>(image.steps.size());
    std::size_t count = 0, metric = 0;
    for (const FeatureStep& step : image.steps) {
      if (!holds(step, image)) continue;
      x[count] = step.to.x() - step.from.x();
      y[count++] = step.to.y() - step.from.y();
      if (step.from_depth_m > 0 && step.to_depth_m > 0) nearing[metric++] = step.from_depth_m / step.to_depth_m;
    }
    if (count == 0 || count < fewest) return std::nullopt;
    const Vector2f displacement(median_in_place(x.first(count)), median_in_place(y.first(count)));
    return Step{displacement, metric > 0 && metric >= fewest ? median_in_place(nearing.first(metric)) : 1.0f};
  }

  /// An edge at the image's border is where the object is cut off, not where it ends: it stays outside.
  void move(const Vector2f& step, float scale, const ImageMotion& image) {
    constexpr float kBorder_px = 6.0f;  // detectors' boxes end some pixels before it
    const auto width = static_cast<float>(image.width), height = static_cast<float>(image.height);
    Box& box = detection.box;
    const Vector2f middle = centre() + step;
    const Vector2f half = 0.5f * scale * Vector2f(box.width, box.height);
    const auto held = [](float before, float after, float border) {
      return before <= border + kBorder_px ? std::min(after, border) : after;
    };
    const float left = held(box.x, middle.x() - half.x(), 0.0f), top = held(box.y, middle.y() - half.y(), 0.0f);
    const float right = -held(-box.x - box.width, -middle.x() - half.x(), -width);
    const float bottom = -held(-box.y - box.height, -middle.y() - half.y(), -height);
    box = {left, top, right - left, bottom - top};
  }

  Vector2f image_px_s_ = Vector2f::Zero();  // of the last step, the camera's share in it
  Vector2f own_px_s_ = Vector2f::Zero();
  Vector2f step_ = Vector2f::Zero();  // that was predicted last
  bool predicted_ = false;            // in the last frame; else seen there
  bool is_followed_ = false;          // by features, at least once since it was seen
};

}  // namespace stillpoint
