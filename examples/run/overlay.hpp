// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Frames with the filter's verdicts drawn on them.

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "frame_record.hpp"
#include "frame_source.hpp"
#include "image_offsets.hpp"
#include "words.hpp"

namespace stillpoint_run {

namespace detail {

// Green, vermilion and grey that the colour-blind tell apart (Okabe and Ito, 2008); B, G, R.
inline const cv::Scalar kKeptColour(115, 200, 60), kDynamicColour(40, 85, 240), kUnknownColour(205, 205, 205),
    kBoxColour(66, 228, 240), kInk(20, 20, 20);

/// A shape for each verdict, too: circle, cross, square. A dropped `unknown` is a square with a bar through it.
inline void draw_feature(cv::Mat& image, const FeatureRow& row, const stillpoint::Vector2f& offset_px) {
  constexpr float kMagnified = 3.0f, kVisible_px = 1.0f, kLongest_px = 40.0f;
  const cv::Point2f at(row.pixel.x(), row.pixel.y());
  const auto stroke = [&image](const cv::Point2f& a, const cv::Point2f& b, const cv::Scalar& colour, int width) {
    cv::line(image, a, b, colour, width, cv::LINE_AA);
  };
  const bool is_dynamic = row.label.verdict == stillpoint::Verdict::dynamic;
  const cv::Scalar colour = is_dynamic                                          ? kDynamicColour
                            : row.label.verdict == stillpoint::Verdict::unknown ? kUnknownColour
                                                                                : kKeptColour;
  const float length_px = offset_px.norm();
  if (length_px >= kVisible_px && length_px <= kLongest_px)
    stroke(at, at - kMagnified * cv::Point2f(offset_px.x(), offset_px.y()), colour, 1);
  if (is_dynamic) {
    for (const auto& [ink, width] : {std::pair(kInk, 2), std::pair(colour, 1)}) {
      stroke(at - cv::Point2f(4, 4), at + cv::Point2f(4, 4), ink, width);
      stroke(at - cv::Point2f(4, -4), at + cv::Point2f(4, -4), ink, width);
    }
  } else if (row.label.verdict == stillpoint::Verdict::unknown) {
    cv::rectangle(image, at - cv::Point2f(3, 3), at + cv::Point2f(3, 3), colour, 1);
    if (!row.label.keep) stroke(at - cv::Point2f(5, 0), at + cv::Point2f(5, 0), colour, 1);
  } else {
    cv::circle(image, at, 3, colour, 1, cv::LINE_AA);
  }
}

/// Solid, or in dashes; what lies far outside of the image is cut off.
inline void draw_box(cv::Mat& image, const cv::Rect2f& whole, int width_px, bool is_dashed) {
  constexpr float kMargin_px = 20.0f;
  const cv::Rect2f box = whole & cv::Rect2f(-kMargin_px, -kMargin_px, static_cast<float>(image.cols) + 2 * kMargin_px,
                                            static_cast<float>(image.rows) + 2 * kMargin_px);
  if (!is_dashed) return cv::rectangle(image, box, kBoxColour, width_px);
  constexpr float kDash_px = 9.0f, kGap_px = 6.0f;
  const auto side = [&](const cv::Point2f& begin, const cv::Point2f& end) {
    const float length_px = std::hypot(end.x - begin.x, end.y - begin.y);
    const cv::Point2f step = (end - begin) / length_px;
    for (float at = 0; at < length_px; at += kDash_px + kGap_px)
      cv::line(image, begin + at * step, begin + std::min(at + kDash_px, length_px) * step, kBoxColour, width_px);
  };
  const cv::Point2f left_top = box.tl(), right_bottom = box.br();
  const cv::Point2f right_top(right_bottom.x, left_top.y), left_bottom(left_top.x, right_bottom.y);
  side(left_top, right_top);
  side(right_top, right_bottom);
  side(left_bottom, right_bottom);
  side(left_top, left_bottom);
}

/// What of a box is the object itself, as a tint.
inline void tint_mask(cv::Mat& image, const stillpoint::Detection& detection) {
  if (!detection.mask) return;
  constexpr double kOpacity = 0.35;
  const stillpoint::Box& box = detection.box;
  const int left = std::max(static_cast<int>(std::ceil(box.x)), 0),
            top = std::max(static_cast<int>(std::ceil(box.y)), 0);
  for (int v = top; v < image.rows && static_cast<float>(v) <= box.y + box.height; ++v) {
    for (int u = left; u < image.cols && static_cast<float>(u) <= box.x + box.width; ++u) {
      const float x = (static_cast<float>(u) - box.x) / box.width, y = (static_cast<float>(v) - box.y) / box.height;
      if (!detection.mask->at(x, y)) continue;
      auto& pixel = image.at<cv::Vec3b>(v, u);
      for (int c = 0; c < 3; ++c)
        pixel[c] = cv::saturate_cast<std::uint8_t>((1 - kOpacity) * pixel[c] + kOpacity * kBoxColour[c]);
    }
  }
}

inline void draw_text(cv::Mat& image, const std::string& text, const cv::Point& at) {
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.5, kInk, 4, cv::LINE_AA);
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar::all(255), 1, cv::LINE_AA);
}

}  // namespace detail

/// Draws the regions that the filter had (those of moving classes thicker, carried ones dashed, masks tinted), each
/// feature by its verdict, its offset three times as long as it is, and the frame's status.
inline cv::Mat draw_overlay(const SourceFrame& frame, const FrameRecord& record,
                            const std::vector<stillpoint::Vector2f>& offsets_px) {
  cv::Mat image = frame.colour.clone();
  for (const auto& [region, class_name] : record.regions) detail::tint_mask(image, region.detection);
  for (const auto& [region, class_name] : record.regions) {
    const stillpoint::Box& found = region.detection.box;
    const cv::Rect2f box(found.x, found.y, found.width, found.height);
    const stillpoint::Mobility mobility = region.detection.mobility;
    detail::draw_box(image, box, mobility == stillpoint::Mobility::dynamic ? 2 : 1, region.is_carried);
    // Of a box that reaches over the image's border the name is drawn inside.
    detail::draw_text(image, (class_name.empty() ? "" : class_name + ": ") + to_string(mobility),
                      cv::Point(cv::Point2f(std::max(box.x, 0.0f), std::max(box.y, 0.0f))) + cv::Point(5, 17));
  }
  for (std::size_t i = 0; i < record.rows.size(); ++i) detail::draw_feature(image, record.rows[i], offsets_px[i]);
  const FrameSummary& summary = record.summary;
  detail::draw_text(image,
                    stillpoint::format_fixed(summary.time_s, 2) + " s  " + to_string(summary.status) + "  kept " +
                        std::to_string(summary.kept) + " of " + std::to_string(summary.features),
                    {8, image.rows - 10});
  return image;
}

}  // namespace stillpoint_run
