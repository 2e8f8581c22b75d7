// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A frame's features as bytes, which page/player.js reads: a thousand in 12 kB.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "frame_record.hpp"
#include "stillpoint/core/geometry.hpp"

namespace stillpoint_run {

namespace detail {

inline std::uint16_t rounded_u16(double value) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 65534.0)));
}

/// The bits of a signed number.
inline std::uint16_t rounded_i16(double value) {
  return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(std::clamp(value, -32767.0, 32767.0))));
}

}  // namespace detail

/// 12 bytes a feature, little-endian:
///   u16 x, u16 y    1/8 px
///   u8  verdict (bits 0-1), kept (bit 2)
///   u8  reason; the one behind the last is the oracle's "label"
///   i16 score       1/100; -32768: not scored
///   i8  offset x, i8 offset y   half pixels; both -128: not known
///   u16 depth       centimetres; 0: none
/// @param offsets_px  as many as the record has rows; NaN where not known
inline std::vector<std::uint8_t> feature_bytes(const FrameRecord& record,
                                               const std::vector<stillpoint::Vector2f>& offsets_px) {
  constexpr double kStepsPerPixel = 8.0, kStepsPerScore = 100.0, kStepsPerOffsetPixel = 2.0, kStepsPerMetre = 100.0;
  constexpr std::uint16_t kNoScore = 0x8000;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(12 * record.rows.size());
  const auto put_u8 = [&bytes](unsigned value) { bytes.push_back(static_cast<std::uint8_t>(value & 255u)); };
  const auto put_u16 = [&put_u8](std::uint16_t value) {
    put_u8(value);
    put_u8(static_cast<unsigned>(value) >> 8);
  };
  for (std::size_t i = 0; i < record.rows.size(); ++i) {
    const FeatureRow& row = record.rows[i];
    put_u16(detail::rounded_u16(kStepsPerPixel * static_cast<double>(row.pixel.x())));
    put_u16(detail::rounded_u16(kStepsPerPixel * static_cast<double>(row.pixel.y())));
    put_u8(static_cast<unsigned>(row.label.verdict) | (row.label.keep ? 4u : 0u));
    const bool is_enumerated = std::strcmp(row.reason, to_string(row.label.reason)) == 0;
    put_u8(is_enumerated ? static_cast<unsigned>(row.label.reason) : static_cast<unsigned>(stillpoint::kReasonCount));
    put_u16(std::isfinite(row.score) ? detail::rounded_i16(kStepsPerScore * static_cast<double>(row.score)) : kNoScore);
    const stillpoint::Vector2f& offset = offsets_px[i];
    for (const float component : {offset.x(), offset.y()})
      put_u8(offset.allFinite() ? static_cast<unsigned>(static_cast<int>(std::lround(std::clamp(
                                      kStepsPerOffsetPixel * static_cast<double>(component), -127.0, 127.0))))
                                : 128u);
    // A depth, however small, is not none.
    put_u16(row.depth_m > 0 ? detail::rounded_u16(std::max(1.0, kStepsPerMetre * row.depth_m)) : std::uint16_t{0});
  }
  return bytes;
}

}  // namespace stillpoint_run
