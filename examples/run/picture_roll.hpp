// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The pictures of the report: every frame, or every so many where all would be too much for one page.

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "feature_bytes.hpp"
#include "frame_record.hpp"
#include "image_offsets.hpp"
#include "overlay.hpp"

namespace stillpoint_run {

/// One frame's image with what is to be drawn on it, in pixels of the camera.
struct Picture {
  std::size_t frame = 0;  ///< of the run, from 0
  std::vector<std::uint8_t> jpeg, features;
  std::vector<RegionRow> regions;
  bool is_special = false;  ///< stays when pictures are given up

  std::size_t bytes() const { return jpeg.size() + features.size(); }
};

/// Keeps as many pictures as fit: whenever they are too many, every second is given up, but none whose status or
/// warnings were new. Call `add` for each frame, in their order.
class PictureRoll {
 public:
  /// Base64 makes a third more of them: 14 MB of the page.
  static constexpr std::size_t kMostBytes = 10'500'000;

  explicit PictureRoll(std::size_t most_bytes = kMostBytes) : most_bytes_(most_bytes) {}

  void add(const SourceFrame& frame, const FrameRecord& record, const stillpoint::Camera& camera) {
    const FrameSummary& summary = record.summary;
    const bool is_new = !last_ || summary.status != last_->status || summary.warnings != last_->warnings;
    const bool is_special = is_new && specials_ < kMostSpecial;
    if (next_ % stride_ == 0 || is_special) {
      pictures_.push_back({next_, encoded(frame, record), feature_bytes(record, offsets_.of(frame, record, camera)),
                           record.regions, is_special});
      bytes_ += pictures_.back().bytes();
      specials_ += is_special ? 1 : 0;
    }
    while (bytes_ > most_bytes_ && stride_ < next_) give_up_every_second();
    offsets_.remember(frame);
    last_ = summary;
    ++next_;
  }

  const std::vector<Picture>& pictures() const { return pictures_; }
  /// From one picture to the next, in frames.
  std::size_t stride() const { return stride_; }

 private:
  static constexpr std::size_t kMostSpecial = 24;

  static std::vector<std::uint8_t> encoded(const SourceFrame& frame, const FrameRecord& record) {
    constexpr int kJpegQuality = 60, kWidest_px = 640;
    cv::Mat image = frame.colour.clone();
    for (const RegionRow& row : record.regions) detail::tint_mask(image, row.region.detection);
    if (image.cols > kWidest_px)
      cv::resize(image, image, {kWidest_px, std::max(1, image.rows * kWidest_px / image.cols)}, 0, 0, cv::INTER_AREA);
    std::vector<std::uint8_t> jpeg;
    cv::imencode(".jpg", image, jpeg, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
    return jpeg;
  }

  void give_up_every_second() {
    stride_ *= 2;
    pictures_.erase(
        std::remove_if(pictures_.begin(), pictures_.end(),
                       [this](const Picture& picture) { return picture.frame % stride_ != 0 && !picture.is_special; }),
        pictures_.end());
    bytes_ = 0;
    for (const Picture& picture : pictures_) bytes_ += picture.bytes();
  }

  std::size_t most_bytes_;
  std::size_t stride_ = 1, next_ = 0, bytes_ = 0, specials_ = 0;
  std::optional<FrameSummary> last_;
  ImageOffsets offsets_;
  std::vector<Picture> pictures_;
};

}  // namespace stillpoint_run
