// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which images of a TUM sequence belong together: associations.txt, or rgb.txt and depth.txt paired by time.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/io/table_reader.hpp"

namespace stillpoint {

/// One frame of a sequence: the colour image's time, and where the images are.
struct TumFrame {
  double timestamp_s = 0.0;
  std::filesystem::path colour_file;
  std::filesystem::path depth_file;
};

namespace detail {

/// An image named by a list.
struct ListedImage {
  double timestamp_s = 0.0;
  std::filesystem::path file;
};

/// The path in a column, below the sequence's folder.
inline std::filesystem::path listed_file(const TableReader& rows, std::size_t column,
                                         const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / std::filesystem::path(std::string(rows[column]));
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    rows.fail_at(column, "file name", "an image that is there; " + file.string() + " is not");
  return file;
}

/// Reads rgb.txt or depth.txt: `timestamp filename`.
inline std::vector<ListedImage> read_image_list(const std::filesystem::path& folder, const char* name) {
  std::vector<ListedImage> images;
  TableReader rows(folder / name);
  for (double previous_s = TableReader::kBeforeAllTime; rows.next_row();) {
    rows.require_columns(2, "timestamp filename");
    const double timestamp_s = rows.time(0, previous_s, true);
    images.push_back({timestamp_s, listed_file(rows, 1, folder)});
  }
  return images;
}

/// Pairs of indices, nearest pairs first, each image used once, in the order of time. As the benchmark's associate.py.
inline std::vector<std::pair<std::size_t, std::size_t>> associate_images(const std::vector<ListedImage>& colour,
                                                                         const std::vector<ListedImage>& depth,
                                                                         double max_time_difference_s) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  for (std::size_t i = 0, first = 0; i < colour.size(); ++i) {
    while (first < depth.size() && !(depth[first].timestamp_s > colour[i].timestamp_s - max_time_difference_s)) ++first;
    for (std::size_t j = first; j < depth.size(); ++j) {
      const double difference_s = depth[j].timestamp_s - colour[i].timestamp_s;
      if (!(difference_s < max_time_difference_s)) break;
      candidates.emplace_back(std::abs(difference_s), i, j);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> colour_taken(colour.size()), depth_taken(depth.size());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [difference_s, i, j] : candidates) {
    if (colour_taken[i] || depth_taken[j]) continue;
    colour_taken[i] = depth_taken[j] = true;
    pairs.emplace_back(i, j);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace detail

/// Reads the frames of a sequence: from associations.txt (`timestamp rgb_file timestamp depth_file`) if there is one,
/// else from rgb.txt and depth.txt, paired by nearest time. A colour image without a depth image is no frame.
/// @param max_time_difference_s  pairs of rgb.txt and depth.txt must be nearer in time than this (the benchmark's 20
/// ms).
/// @return        at least one frame, times rising.
/// @throws Error if a list is missing or says nothing; with file and line for a row of other columns, a time that does
///         not rise, or a file that is not there.
inline std::vector<TumFrame> read_tum_frames(const std::filesystem::path& folder, double max_time_difference_s = 0.02) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    throw Error(folder.string() + ": " +
                (std::filesystem::exists(folder, ignored) ? "not a folder" : "no such folder") +
                ", expected the folder of a TUM sequence");
  std::vector<TumFrame> frames;
  const std::filesystem::path associations = folder / "associations.txt";
  if (std::filesystem::exists(associations, ignored)) {
    TableReader rows(associations);
    for (double previous_s = TableReader::kBeforeAllTime; rows.next_row();) {
      rows.require_columns(4, "timestamp rgb_file timestamp depth_file");
      const double timestamp_s = rows.time(0, previous_s, true);
      rows.number(2, "timestamp");
      frames.push_back({timestamp_s, detail::listed_file(rows, 1, folder), detail::listed_file(rows, 3, folder)});
    }
    if (frames.empty()) throw Error(associations.string() + ": found no row, expected at least one frame");
    return frames;
  }

  const auto colour = detail::read_image_list(folder, "rgb.txt");
  const auto depth = detail::read_image_list(folder, "depth.txt");
  for (const auto& [i, j] : detail::associate_images(colour, depth, max_time_difference_s))
    frames.push_back({colour[i].timestamp_s, colour[i].file, depth[j].file});
  if (frames.empty())
    throw Error(folder.string() + ": found no pair among " + std::to_string(colour.size()) + " images of rgb.txt and " +
                std::to_string(depth.size()) + " of depth.txt, expected times less than " +
                format_fixed(max_time_difference_s, 3) + " s apart");
  return frames;
}

}  // namespace stillpoint
