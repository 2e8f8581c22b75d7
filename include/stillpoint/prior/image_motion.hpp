// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How the image moved from frame to frame, remembered for answers that come late.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"

namespace stillpoint {

/// One feature in the frame before and in this one.
struct FeatureStep {
  Vector2f from, to;                       ///< pixels
  float from_depth_m = 0, to_depth_m = 0;  ///< metres, 0 none
};

/// What is kept of one frame: a coarse depth image, and what moved how since the frame before.
class ImageMotion {
 public:
  double timestamp_s = 0.0;
  double elapsed_s = 0.0;  ///< since the frame before; 0 where there is none
  int width = 0, height = 0;
  std::vector<FeatureStep> steps;  ///< empty where nobody has told
  bool has_depths = false;         ///< of any step: without, the method looks at no depth

  /// Begins with the frame alone.
  void begin(const FrameView& frame, double previous_timestamp_s) {
    timestamp_s = frame.timestamp_s;
    elapsed_s = std::isfinite(previous_timestamp_s) ? timestamp_s - previous_timestamp_s : 0.0;
    width = frame.image().width;
    height = frame.image().height;
    steps.clear();
    has_depths = knows_camera_ = false;
    copy_coarsely(frame.depth.image.empty() ? DepthView() : frame.depth);
  }

  /// Takes the memory that a frame of another one's size needs.
  void take_size(const ImageMotion& other) {
    const ImageView like = other.depth_.view();
    depth_.resize(like.width, like.height, like.format);
  }

  /// The image's depth at one pixel in eight: enough for the depth of a box.
  DepthView depth() const { return DepthView(depth_.view()); }
  DepthScale to_depth() const { return {ImageView(nullptr, width, height, 0, PixelFormat::gray8), depth_.view()}; }

  void set_steps(const Matches& matches) {
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (!matches.matched(i)) continue;
      steps.push_back({matches.reference.pixel[i], matches.current.pixel[i],
                       static_cast<float>(matches.reference.depth_m[i]),
                       static_cast<float>(matches.current.depth_m[i])});
      has_depths |= matches.current.has_depth(i);
    }
  }

  /// Keeps K R K⁻¹ and K t, which say where a static point goes; of a motion without a scale the rotation alone. The
  /// lens's distortion is left out: the few pixels between two frames hardly differ by it.
  template <class Camera>
  void set_camera_motion(const Motion& motion, const Camera& camera) {
    const Vector2d centre = camera.project(Vector3d(0, 0, 1));
    const Vector2d focal = camera.project(Vector3d(1, 1, 1)) - centre;
    Matrix3d k;
    k << focal.x(), 0, centre.x(), 0, focal.y(), centre.y(), 0, 0, 1;
    Matrix3d k_inverse;
    k_inverse << 1 / focal.x(), 0, -centre.x() / focal.x(), 0, 1 / focal.y(), -centre.y() / focal.y(), 0, 0, 1;
    turn_ = k * rotation_of(motion.current_from_reference) * k_inverse;
    shift_ = motion.metric ? Vector3d(k * translation_of(motion.current_from_reference)) : Vector3d(Vector3d::Zero());
    knows_camera_ = true;
  }
  bool knows_camera() const noexcept { return knows_camera_; }

  /// How far a static point moved in the image.
  /// @param from     pixel in the frame before
  /// @param depth_m  infinity where it is not known: what is far moves by the camera's rotation alone
  Vector2f static_step(const Vector2f& from, double depth_m) const {
    const Vector3d ray(static_cast<double>(from.x()), static_cast<double>(from.y()), 1);
    const Vector3d there = turn_ * ray + shift_ / depth_m;
    if (!(there.z() > 0)) return Vector2f::Zero();
    return to_float(Vector2d(there.x() / there.z(), there.y() / there.z())) - from;
  }

 private:
  void copy_coarsely(const DepthView& full) {
    constexpr int kStride = 8;
    const int columns = full.image.width / kStride, rows = full.image.height / kStride;
    if (columns == 0 || rows == 0) return depth_.resize(0, 0, PixelFormat::none);
    depth_.resize(columns, rows, PixelFormat::depth32f);
    for (int v = 0; v < rows; ++v)
      for (int u = 0; u < columns; ++u)
        depth_.row<float>(v)[u] =
            full.metres(u * full.image.width / columns + kStride / 2, v * full.image.height / rows + kStride / 2);
  }

  ImageBuffer depth_;
  bool knows_camera_ = false;
  Matrix3d turn_ = Matrix3d::Identity();
  Vector3d shift_ = Vector3d::Zero();
};

/// The last frames, oldest first. Slots are reused: no allocation once the fullest frame has been seen.
class ImageMotions {
 public:
  static constexpr std::size_t kCapacity = 192;  ///< two seconds at 90 Hz, 6 MB with 500 features per frame

  std::size_t size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  void clear() noexcept { size_ = 0; }

  ImageMotion& operator[](std::size_t i) noexcept { return ring_[(head_ + kCapacity - size_ + i) % kCapacity]; }
  const ImageMotion& operator[](std::size_t i) const noexcept {
    return ring_[(head_ + kCapacity - size_ + i) % kCapacity];
  }
  ImageMotion& newest() noexcept { return (*this)[size_ - 1]; }
  const ImageMotion& newest() const noexcept { return (*this)[size_ - 1]; }

  /// The oldest is overwritten when the ring is full.
  ImageMotion& push(const FrameView& frame) {
    const double previous_s = empty() ? std::numeric_limits<double>::quiet_NaN() : newest().timestamp_s;
    ImageMotion& slot = ring_[head_];
    head_ = (head_ + 1) % kCapacity;
    size_ = std::min(size_ + 1, kCapacity);
    slot.begin(frame, previous_s);
    return slot;
  }

  /// Makes room in every slot for so many features, so that its first use does not allocate.
  void reserve(std::size_t features) {
    if (features <= reserved_ && size_ > 1) return;
    reserved_ = std::max(features, reserved_);
    for (ImageMotion& slot : ring_) slot.steps.reserve(reserved_);
    for (std::size_t i = size_; i < kCapacity; ++i) (*this)[i].take_size(newest());
  }

  /// Index of the frame that was taken nearest to a time; at least one frame.
  std::size_t nearest(double timestamp_s) const noexcept {
    std::size_t best = 0;
    for (std::size_t i = 1; i < size_; ++i)
      if (std::abs((*this)[i].timestamp_s - timestamp_s) < std::abs((*this)[best].timestamp_s - timestamp_s)) best = i;
    return best;
  }

 private:
  std::vector<ImageMotion> ring_ = std::vector<ImageMotion>(kCapacity);
  std::size_t head_ = 0;
  std::size_t size_ = 0;
  std::size_t reserved_ = 0;
};

}  // namespace stillpoint
