// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Does a video file break off? AVI, MP4 (QuickTime) and Matroska (WebM) say how long they are; decoders fill up what is
// missing and say nothing.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>
#include <string>
#include <string_view>
#include <system_error>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint::detail {

/// Reads an unsigned integer of so many bytes. At the end of the file it returns 0, and the stream is in its fail
/// state.
inline std::uint64_t read_number(std::istream& stream, int bytes, bool is_big_endian) {
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) {
    const int byte = stream.get();
    if (byte < 0) return 0;
    value |= static_cast<std::uint64_t>(byte) << (8 * (is_big_endian ? bytes - 1 - i : i));
  }
  return value;
}

/// A size of Matroska: as many leading zeros as bytes follow. All ones: not known.
inline std::uint64_t read_matroska_size(std::istream& stream) {
  constexpr std::uint64_t kUnknown = 0;
  const int first = stream.get();
  int more = 0;
  for (int mask = 128; more < 8 && first > 0 && (first & mask) == 0; mask >>= 1) ++more;
  if (first <= 0) return kUnknown;
  std::uint64_t value = static_cast<std::uint64_t>(first) & (0x7fu >> more);
  const std::uint64_t all_ones = (std::uint64_t{1} << (7 * (more + 1))) - 1;
  value = value << (8 * more) | read_number(stream, more, true);
  return value == all_ones ? kUnknown : value;
}

/// Boxes that stand side by side in a file (ISO/IEC 14496-12, and QuickTime's).
inline bool is_mp4_box(std::string_view name) {
  for (const std::string_view known : {"ftyp", "moov", "mdat", "free", "skip", "wide", "pnot", "udta", "uuid", "meta",
                                       "pdin", "moof", "mfra", "sidx", "ssix", "styp", "prft", "emsg"})
    if (name == known) return true;
  return false;
}

/// How many bytes the file says that it has at least, as far as its outermost parts tell; 0 where it does not say.
inline std::uint64_t stated_size(std::istream& stream, std::uint64_t size) {
  char head[8] = {};
  stream.read(head, sizeof head);
  const std::string_view begin(head, 4), type(head + 4, 4);
  if (begin == "RIFF") {                             // as much as the first RIFF chunk; large files have more of them
    constexpr std::uint64_t kUnknown = 0xffffffffu;  // of a writer that could not go back to the beginning
    stream.seekg(4);
    const std::uint64_t length = read_number(stream, 4, false);
    return length == kUnknown ? 0 : length + 8;
  }
  if (type == "ftyp" || type == "moov" || type == "mdat") {
    std::uint64_t at = 0;
    for (int parts = 0; at + 8 <= size && parts < 10000; ++parts) {
      stream.seekg(static_cast<std::streamoff>(at));
      std::uint64_t length = read_number(stream, 4, true);
      char name[4] = {};
      stream.read(name, sizeof name);
      if (!is_mp4_box({name, 4})) return at;  // what a camera's maker has put behind
      if (length == 1) length = read_number(stream, 8, true);
      if (length < 8 || at + length < at) return at;  // 0: up to the end
      at += length;
    }
    return at;
  }
  if (begin == "\x1a\x45\xdf\xa3") {
    stream.seekg(4);
    const std::uint64_t header = read_matroska_size(stream);
    stream.seekg(static_cast<std::streamoff>(header), std::ios::cur);
    if (read_number(stream, 4, true) != 0x18538067) return 0;  // the segment
    const std::uint64_t segment = read_matroska_size(stream);
    return segment == 0 ? 0 : static_cast<std::uint64_t>(stream.tellg()) + segment;
  }
  return 0;
}

/// What a video says that its size is, and what it is, bytes.
struct VideoSize {
  std::uint64_t stated = 0;  ///< 0: the format does not tell, or the file cannot be read
  std::uint64_t found = 0;
};

inline VideoSize size_of_video(const std::filesystem::path& file) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream) return {};
  return {stated_size(stream, size), size};
}

/// What is missing of a video, in bytes; 0 where nothing is, or the format does not tell.
inline std::uint64_t missing_bytes(const std::filesystem::path& file) {
  const VideoSize size = size_of_video(file);
  return size.stated > size.found ? size.stated - size.found : 0;
}

}  // namespace stillpoint::detail
