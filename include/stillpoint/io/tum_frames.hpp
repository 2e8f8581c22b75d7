// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which images of a TUM sequence belong together: associations.txt, or rgb.txt and depth.txt paired by time.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <queue>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/io/listed_files.hpp"
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
inline std::filesystem::path listed_path(const TableReader& rows, std::size_t column,
                                         const std::filesystem::path& folder) {
  return folder / std::filesystem::path(std::string(rows[column]));
}

/// Reads rgb.txt or depth.txt: `timestamp filename`.
/// @param missing_files  grows by those that are left out
inline std::vector<ListedImage> read_image_list(const std::filesystem::path& folder, const char* name,
                                                std::size_t& missing_files) {
  std::vector<ListedImage> images;
  TableReader rows(folder / name);
  ListedFiles files;
  for (double previous_s = TableReader::kBeforeAllTime; rows.next_row();) {
    rows.require_columns(2, "timestamp filename");
    const double timestamp_s = rows.time(0, previous_s, true);
    const std::filesystem::path file = listed_path(rows, 1, folder);
    if (files.is_there(rows, 1, file)) images.push_back({timestamp_s, file});
  }
  missing_files += files.missing();
  return images;
}

/// Pairs of indices, nearest pairs first, each image used once, in the order of time. As the benchmark's associate.py,
/// but in O(n log n): times rise, so that the nearest pair that is left is of two neighbours in time.
inline std::vector<std::pair<std::size_t, std::size_t>> associate_images(const std::vector<ListedImage>& colour,
                                                                         const std::vector<ListedImage>& depth,
                                                                         double max_time_difference_s) {
  // All images in the order of time, each linked with the one before and the one after it that are not taken yet.
  struct Link {
    bool is_colour;
    std::size_t index, before, after;
  };
  std::vector<Link> links(1);  // the first is before all and behind all
  for (std::size_t i = 0, j = 0; i < colour.size() || j < depth.size();) {
    const bool is_colour = j == depth.size() || (i < colour.size() && colour[i].timestamp_s <= depth[j].timestamp_s);
    links.push_back({is_colour, is_colour ? i++ : j++, links.size() - 1, links.size() + 1});
  }
  links.back().after = 0;

  // Difference, colour, depth, and their links in order. Neighbours stay neighbours until one of them is taken.
  using Candidate = std::tuple<double, std::size_t, std::size_t, std::size_t, std::size_t>;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> nearest;
  const auto consider = [&](std::size_t first) {
    const std::size_t second = links[first].after;
    if (first == 0 || second == 0 || links[first].is_colour == links[second].is_colour) return;
    const std::size_t i = links[links[first].is_colour ? first : second].index,
                      j = links[links[first].is_colour ? second : first].index;
    const double colour_s = colour[i].timestamp_s, depth_s = depth[j].timestamp_s;
    if (depth_s > colour_s - max_time_difference_s && depth_s - colour_s < max_time_difference_s)
      nearest.emplace(std::abs(depth_s - colour_s), i, j, first, second);
  };
  for (std::size_t link = 1; link < links.size(); ++link) consider(link);

  std::vector<bool> is_taken(links.size());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  while (!nearest.empty()) {
    const auto [difference_s, i, j, first, second] = nearest.top();
    nearest.pop();
    if (is_taken[first] || is_taken[second]) continue;
    is_taken[first] = is_taken[second] = true;
    pairs.emplace_back(i, j);
    const std::size_t before = links[first].before, after = links[second].after;
    links[before].after = after;
    links[after].before = before;
    consider(before);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace detail

/// The frames of a sequence, and how many images its lists name that are not there.
struct TumFrames {
  std::vector<TumFrame> frames;
  std::size_t missing_files = 0;         ///< their frames are left out
  std::size_t images_without_depth = 0;  ///< of rgb.txt: no depth image is near enough in time
};

/// Reads the frames of a sequence: from associations.txt (`timestamp rgb_file timestamp depth_file`) if there is one,
/// else from rgb.txt and depth.txt, paired by nearest time. A colour image without a depth image is no frame.
/// @param max_time_difference_s  pairs of rgb.txt and depth.txt must be nearer in time than this (the benchmark's 20
/// ms).
/// @return        at least one frame, times rising.
/// @throws Error if the limit is no time, a list is missing or says nothing, or more than a tenth of the images that it
///         names is missing; with file and line for a row of other columns or a time that does not rise.
inline TumFrames list_tum_frames(const std::filesystem::path& folder, double max_time_difference_s = 0.02) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    throw Error(folder.string() + ": " +
                (std::filesystem::exists(folder, ignored) ? "not a folder" : "no such folder") +
                ", expected the folder of a TUM sequence");
  TumFrames list;
  const std::filesystem::path associations = folder / "associations.txt";
  if (std::filesystem::exists(associations, ignored)) {
    TableReader rows(associations);
    detail::ListedFiles files;
    for (double previous_s = TableReader::kBeforeAllTime; rows.next_row();) {
      rows.require_columns(4, "timestamp rgb_file timestamp depth_file");
      const double timestamp_s = rows.time(0, previous_s, true);
      rows.number(2, "timestamp");
      const std::filesystem::path colour = detail::listed_path(rows, 1, folder),
                                  depth = detail::listed_path(rows, 3, folder);
      const bool has_colour = files.is_there(rows, 1, colour), has_depth = files.is_there(rows, 3, depth);
      if (has_colour && has_depth) list.frames.push_back({timestamp_s, colour, depth});
    }
    list.missing_files = files.missing();
    if (list.frames.empty()) throw Error(associations.string() + ": found no row, expected at least one frame");
    return list;
  }

  if (!(max_time_difference_s > 0))
    throw Error("max_time_difference_s is " + option_text(max_time_difference_s) + ", expected more than 0 seconds");
  const auto colour = detail::read_image_list(folder, "rgb.txt", list.missing_files);
  const auto depth = detail::read_image_list(folder, "depth.txt", list.missing_files);
  for (const auto& [i, j] : detail::associate_images(colour, depth, max_time_difference_s))
    list.frames.push_back({colour[i].timestamp_s, colour[i].file, depth[j].file});
  list.images_without_depth = colour.size() - list.frames.size();
  if (list.frames.empty())
    throw Error(folder.string() + ": found no pair among " + std::to_string(colour.size()) + " images of rgb.txt and " +
                std::to_string(depth.size()) + " of depth.txt, expected times less than " +
                format_fixed(max_time_difference_s, 3) + " s apart");
  return list;
}

/// The frames of `list_tum_frames` alone.
inline std::vector<TumFrame> read_tum_frames(const std::filesystem::path& folder, double max_time_difference_s = 0.02) {
  return list_tum_frames(folder, max_time_difference_s).frames;
}

}  // namespace stillpoint
