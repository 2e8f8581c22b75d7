// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What is missing?   A node that waits without a word is the commonest trouble with ROS: wrong topic, other clock.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/io/number_format.hpp"
#include "stillpoint_ros/frame_pairing.hpp"

namespace stillpoint_ros {

enum class Input : std::size_t { image, depth, camera_info };
inline constexpr std::size_t kInputCount = 3;

/// Counts what comes and says what does not. Times are of any clock that runs evenly.
class InputWatch {
 public:
  /// @param topics  their names as the user knows them, in the order of `Input`
  explicit InputWatch(std::array<std::string, kInputCount> topics) : topics_(std::move(topics)) {}

  void seen(Input input, double now_s) noexcept {
    const auto i = static_cast<std::size_t>(input);
    if (last_s_[i]) period_s_[i] = now_s - *last_s_[i];
    last_s_[i] = now_s;
  }
  void paired(double now_s) noexcept { last_pair_s_ = now_s; }
  /// A message could not be read: why, in one sentence.
  void rejected(double now_s, std::string why) {
    last_rejected_s_ = now_s;
    why_ = std::move(why);
  }

  /// One sentence for each fault that keeps frames from being judged; none where all is well.
  std::vector<std::string> missing(double now_s, FramePairing& pairing) const {
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < kInputCount; ++i) {
      const std::string what = std::string(kNames[i]) + " on " + topics_[i];
      if (!last_s_[i])
        sentences.push_back("no " + what + " yet");
      else if (i != static_cast<std::size_t>(Input::camera_info) && now_s - *last_s_[i] > silence_s(i))
        sentences.push_back("no " + what + " for " + seconds(now_s - *last_s_[i]) + " s");
    }
    if (is_recent(last_rejected_s_, now_s, kSilence_s)) sentences.push_back(why_);
    if (sentences.empty() && !is_recent(last_pair_s_, now_s, std::max(silence_s(0), silence_s(1))))
      sentences.push_back(unpaired(pairing));
    return sentences;
  }

 private:
  static constexpr const char* kNames[kInputCount] = {"image", "depth", "camera_info"};
  static constexpr double kSilence_s = 1.0;
  static constexpr double kPeriods = 2.5;  // of a slow stream: one message was lost, and the next is late

  double silence_s(std::size_t input) const noexcept { return std::max(kSilence_s, kPeriods * period_s_[input]); }

  static bool is_recent(const std::optional<double>& time_s, double now_s, double recent_s) {
    return time_s && now_s - *time_s <= recent_s;
  }
  static std::string seconds(double value_s) { return stillpoint::format_fixed(value_s, value_s < 10 ? 3 : 0); }

  /// All comes, and nothing fits together.
  std::string unpaired(FramePairing& pairing) const {
    if (const RawImage* const image = pairing.image_without_camera())
      return "the image has " + std::to_string(image->width) + "x" + std::to_string(image->height) +
             " pixels, expected the size that camera_info on " + topics_[2] + " says";
    if (const auto stamp_s = pairing.image_not_later_s()) return not_growing(Input::image, *stamp_s);
    if (const auto stamp_s = pairing.depth_not_later_s()) return not_growing(Input::depth, *stamp_s);
    const double apart_s = pairing.nearest_difference_s();
    if (!std::isfinite(apart_s)) return "image and depth do not come at the same time";
    return "image and depth are " + seconds(apart_s) + " s apart, expected at most sync_tolerance_s, " +
           seconds(pairing.options.tolerance_s) + " s";
  }

  std::string not_growing(Input input, double stamp_s) const {
    const auto i = static_cast<std::size_t>(input);
    return std::string("stamps of ") + kNames[i] + " on " + topics_[i] + " do not grow: the last is " +
           seconds(stamp_s) +
           " s, not later than the last frame's, expected the time of each image in its header.stamp";
  }

  std::array<std::string, kInputCount> topics_;
  std::array<std::optional<double>, kInputCount> last_s_;
  std::array<double, kInputCount> period_s_{};  // between the last two; 0 until then
  std::optional<double> last_pair_s_, last_rejected_s_;
  std::string why_;
};

}  // namespace stillpoint_ros
