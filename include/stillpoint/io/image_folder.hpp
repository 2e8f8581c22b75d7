// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A folder of images as a sequence, or two of them as a stereo sequence: order and time by the files' names.

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/io/frame_rate.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/io/stereo_images.hpp"

namespace stillpoint {

/// One image and when it was taken.
struct TimedImage {
  double timestamp_s = 0.0;
  std::filesystem::path file;
};

/// The images of a folder, in their order.
struct ImageList {
  std::vector<TimedImage> images;
  bool rate_is_assumed = false;  ///< neither the caller nor the names told the time
};

/// Images per second where nothing tells.
inline constexpr double kAssumedFrameRate_hz = 30.0;

namespace detail {

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The number that begins at `at`, without leading zeros; moves `at` behind it.
inline std::string_view digits_from(std::string_view text, std::size_t& at) {
  while (at < text.size() && text[at] == '0') ++at;
  const std::size_t begin = at;
  while (at < text.size() && is_digit(text[at])) ++at;
  return text.substr(begin, at - begin);
}

/// Whether a name stands before another one as people count: image_9 before image_10.
inline bool naturally_less(std::string_view a, std::string_view b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string_view m = digits_from(a, i), n = digits_from(b, j);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  if (i < a.size() || j < b.size()) return i == a.size();
  return a < b;  // alike but for leading zeros
}

/// By the extension. A hidden file is no image: macOS writes `._0000.png` beside `0000.png`.
inline bool is_image_name(const std::filesystem::path& file) {
  if (file.filename().string().rfind('.', 0) == 0) return false;
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* known : {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".pgm", ".ppm", ".webp"})
    if (extension == known) return true;
  return false;
}

/// Seconds that a file's name tells: seconds with decimals (TUM), or as many digits as milli-, micro- or nanoseconds
/// (EuRoC) since 1970 have had since 2001. A shorter whole number is a counter.
inline std::optional<double> time_of_name(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  if (stem.empty() || !is_digit(stem.front()) || !is_digit(stem.back())) return std::nullopt;
  const auto number = parse_number(stem);
  if (!number || stem.find_first_not_of("0123456789.") != stem.npos) return std::nullopt;
  if (stem.find('.') != stem.npos) return number;
  if (stem.front() == '0') return std::nullopt;  // a counter, filled up
  switch (stem.size()) {
    case 13: return *number * 1e-3;
    case 16: return *number * 1e-6;
    case 19: return *number * 1e-9;
    default: return std::nullopt;
  }
}

/// In the natural order of their names.
inline std::vector<std::filesystem::path> image_files(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw Error(folder.string() + ": " + (std::filesystem::exists(folder, error) ? "not a folder" : "no such folder") +
                ", expected a folder of images");
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (is_image_name(entry->path()) && entry->is_regular_file(error)) files.push_back(entry->path());
  if (error) throw Error(folder.string() + ": cannot be read (" + error.message() + ")");
  if (files.empty())
    throw Error(folder.string() +
                ": found no image, expected files named .png, .jpg, .jpeg, .bmp, .tif, .tiff, .pgm, .ppm or .webp");
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return naturally_less(a.filename().string(), b.filename().string()); });
  return files;
}

}  // namespace detail

/// Lists the images of a folder: in the order of the times in their names where all have one (see
/// `detail::time_of_name`), else in the natural order of their names. Sub-folders and hidden files are not looked at.
/// @param frame_rate_hz  images per second. Without: the names' times where all have one, else `kAssumedFrameRate_hz`.
///                       Times by a rate begin at 0.
/// @return        at least one image, times rising.
/// @throws Error if the folder is missing or holds no image, the rate is not positive and finite, or two names tell the
///         same time and no rate is given.
inline ImageList read_image_folder(const std::filesystem::path& folder,
                                   std::optional<double> frame_rate_hz = std::nullopt) {
  if (frame_rate_hz) detail::require_frame_rate(*frame_rate_hz);
  ImageList list;
  bool names_tell = true;
  for (const std::filesystem::path& file : detail::image_files(folder)) {
    const auto time_s = names_tell ? detail::time_of_name(file) : std::nullopt;
    names_tell = time_s.has_value();
    list.images.push_back({time_s.value_or(0.0), file});
  }
  // The natural order takes 3 in "0.3" for less than 15 in "0.15".
  if (names_tell)
    std::stable_sort(list.images.begin(), list.images.end(),
                     [](const TimedImage& a, const TimedImage& b) { return a.timestamp_s < b.timestamp_s; });
  if (frame_rate_hz || !names_tell) {
    list.rate_is_assumed = !frame_rate_hz;
    for (std::size_t i = 0; i < list.images.size(); ++i)
      list.images[i].timestamp_s = static_cast<double>(i) / frame_rate_hz.value_or(kAssumedFrameRate_hz);
    return list;
  }
  for (std::size_t i = 1; i < list.images.size(); ++i)
    if (!(list.images[i].timestamp_s > list.images[i - 1].timestamp_s))
      throw Error(list.images[i].file.string() + ": found the time " + format_timestamp(list.images[i].timestamp_s) +
                  " s in its name, expected one later than that of " + list.images[i - 1].file.filename().string());
  return list;
}

/// Pairs the left images with those of the same name in another folder.
/// @return        in the order of the left images: of their times.
/// @throws Error if that folder is missing or holds no image; naming the first image that is in one folder only.
inline std::vector<StereoFrame> pair_with_right_folder(const ImageList& left,
                                                       const std::filesystem::path& right_folder) {
  const std::vector<std::filesystem::path> right = detail::image_files(right_folder);
  const auto name_of = [](const std::filesystem::path& file) { return file.filename().string(); };
  std::vector<TimedImage> images = left.images;  // in the order of names, as the right ones
  std::sort(images.begin(), images.end(), [&](const TimedImage& a, const TimedImage& b) {
    return detail::naturally_less(name_of(a.file), name_of(b.file));
  });
  std::vector<StereoFrame> frames;
  for (std::size_t i = 0; i < std::max(images.size(), right.size()); ++i) {
    const bool has_left = i < images.size(), has_right = i < right.size();
    if (has_left && has_right && name_of(images[i].file) == name_of(right[i])) {
      frames.push_back({images[i].timestamp_s, images[i].file, right[i]});
      continue;
    }
    // The one whose name comes first is alone.
    const bool left_is_alone =
        has_left && (!has_right || detail::naturally_less(name_of(images[i].file), name_of(right[i])));
    const std::filesystem::path alone = left_is_alone ? images[i].file : right[i];
    throw Error(alone.string() + ": found no image of this name in the folder of the " +
                (left_is_alone ? "right" : "left") + " camera, expected the same names in both");
  }
  std::sort(frames.begin(), frames.end(),
            [](const StereoFrame& a, const StereoFrame& b) { return a.timestamp_s < b.timestamp_s; });
  return frames;
}

}  // namespace stillpoint
