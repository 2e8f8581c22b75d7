// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/io/tum_frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint {
namespace {

/// A folder with five files for each kind of image.
struct ImageFolder : TemporaryFolder {
  ImageFolder() {
    for (int i = 0; i < 5; ++i) {
      write("rgb/" + std::to_string(i) + ".jpg", "");
      write("depth/" + std::to_string(i) + ".png", "");
    }
  }
};

std::vector<double> times(const std::vector<TumFrame>& frames) {
  std::vector<double> result;
  for (const TumFrame& frame : frames) result.push_back(frame.timestamp_s);
  return result;
}

TEST(ReadTumFrames, TakesAssociationsFirst) {
  const ImageFolder folder;
  folder.write("rgb.txt", "garbage that nobody reads\n");
  folder.write("associations.txt", "# comment\n1.0 rgb/0.jpg 1.01 depth/3.png\n1.1 rgb/1.jpg 1.11 depth/1.png\n");
  const auto frames = read_tum_frames(folder.path());
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].timestamp_s, 1.0);
  EXPECT_EQ(frames[0].colour_file, folder.path() / "rgb/0.jpg");
  EXPECT_EQ(frames[0].depth_file, folder.path() / "depth/3.png");
}

TEST(ReadTumFrames, PairsListsByNearestTimeEachImageOnce) {
  const ImageFolder folder;
  // 1.000 is nearest to 1.012 (12 ms), which is nearer to 1.010 (2 ms); 1.000 then takes 0.985 (15 ms). 2.000 finds
  // 2.015 and not 1.975 (25 ms). 3.000 has only one at 3.020, which is not nearer than 20 ms.
  folder.write("rgb.txt", "1.000 rgb/0.jpg\n1.010 rgb/1.jpg\n2.000 rgb/2.jpg\n3.000 rgb/3.jpg\n");
  folder.write("depth.txt",
               "0.985 depth/0.png\n1.012 depth/1.png\n1.975 depth/2.png\n2.015 depth/3.png\n3.021 depth/4.png\n");
  const auto frames = read_tum_frames(folder.path());
  EXPECT_EQ(times(frames), (std::vector<double>{1.0, 1.01, 2.0}));
  EXPECT_EQ(frames[0].depth_file, folder.path() / "depth/0.png");
  EXPECT_EQ(frames[1].depth_file, folder.path() / "depth/1.png");
  EXPECT_EQ(frames[2].depth_file, folder.path() / "depth/3.png");
}

TEST(ReadTumFrames, PairsAgreeWithTheGreedySearchOverAll) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const auto images = [&random](std::size_t count) {
      std::vector<detail::ListedImage> result;
      double time_s = 0.0;
      for (std::size_t i = 0; i < count; ++i) result.push_back({time_s += random.uniform(0.001, 0.04), ""});
      return result;
    };
    const auto colour = images(25), depth = images(25);
    std::vector<bool> colour_taken(25), depth_taken(25);
    std::vector<std::pair<std::size_t, std::size_t>> expected;
    for (;;) {
      double nearest_s = 0.02;
      std::size_t best_i = 25, best_j = 25;
      for (std::size_t i = 0; i < 25; ++i)
        for (std::size_t j = 0; j < 25; ++j) {
          const double difference_s = std::abs(colour[i].timestamp_s - depth[j].timestamp_s);
          if (colour_taken[i] || depth_taken[j] || !(difference_s < nearest_s)) continue;
          nearest_s = difference_s;
          best_i = i;
          best_j = j;
        }
      if (best_i == 25) break;
      colour_taken[best_i] = depth_taken[best_j] = true;
      expected.emplace_back(best_i, best_j);
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(detail::associate_images(colour, depth, 0.02), expected) << "seed " << seed;
  }
}

// 64 million pairs are near enough; to list them all takes the better part of a minute.
TEST(ReadTumFrames, ManyImagesAtNearlyTheSameTimeTakeNoTime) {
  constexpr std::size_t kImages = 8000;
  std::vector<detail::ListedImage> colour, depth;
  for (std::size_t i = 0; i < kImages; ++i) {
    colour.push_back({1e-6 * static_cast<double>(i), ""});
    depth.push_back({1e-6 * static_cast<double>(i) + 4e-7, ""});
  }
  const std::clock_t begin = std::clock();
  const auto pairs = detail::associate_images(colour, depth, 0.02);
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 2.0);
  ASSERT_EQ(pairs.size(), kImages);
  for (std::size_t i = 0; i < kImages; ++i) EXPECT_EQ(pairs[i], (std::pair{i, i}));
}

// Depth at half the rate of colour.
TEST(ReadTumFrames, CountsImagesThatHaveNoDepthOfTheirTime) {
  const TemporaryFolder folder;
  std::string rgb, depth;
  for (int i = 0; i < 10; ++i) {
    const std::string row = std::to_string(0.1 * i) + " i/" + std::to_string(i) + '\n';
    folder.write("i/" + std::to_string(i), "");
    rgb += row;
    if (i % 2 == 0) depth += row;
  }
  folder.write("rgb.txt", rgb);
  folder.write("depth.txt", depth);
  const TumFrames list = list_tum_frames(folder.path());
  EXPECT_EQ(list.frames.size(), 5u);
  EXPECT_EQ(list.images_without_depth, 5u);
  EXPECT_EQ(list.missing_files, 0u);
  EXPECT_EQ(error_of([&] { list_tum_frames(folder.path(), -0.02); }),
            "max_time_difference_s is -0.02, expected more than 0 seconds");
}

TEST(ReadTumFrames, LeavesOutWhatIsMissingUpToATenth) {
  const TemporaryFolder folder;
  std::string rgb, depth, associations;
  for (int i = 0; i < 20; ++i) {
    const std::string number = std::to_string(i), time = std::to_string(0.1 * i) + ' ';
    folder.write("rgb/" + number, "");
    folder.write("depth/" + number, "");
    rgb += time + "rgb/" + number + '\n';
    depth += time + "depth/" + number + '\n';
    associations += time + "rgb/" + number + ' ' + time + "depth/" + number + '\n';
  }
  folder.write("rgb.txt", rgb);
  folder.write("depth.txt", depth);
  std::filesystem::remove(folder.path() / "rgb/3");
  std::filesystem::remove(folder.path() / "depth/7");
  for (const bool has_associations : {false, true}) {
    if (has_associations) folder.write("associations.txt", associations);
    const TumFrames list = list_tum_frames(folder.path());
    EXPECT_EQ(list.frames.size(), 18u);
    EXPECT_EQ(list.missing_files, 2u);
    EXPECT_EQ(list.frames[3].timestamp_s, 0.4);
    EXPECT_EQ(list.images_without_depth, has_associations ? 0u : 1u) << "rgb/7";
    EXPECT_EQ(read_tum_frames(folder.path()).size(), 18u);
  }
  for (const char* more : {"rgb/4", "rgb/5", "rgb/6"}) std::filesystem::remove(folder.path() / more);
  EXPECT_EQ(error_of([&] { list_tum_frames(folder.path()); }),
            (folder.path() / "associations.txt").string() +
                ":4: found file name 'rgb/3', expected an image that is there; " + (folder.path() / "rgb/3").string() +
                " is not, and 4 more of the 40 that the list names are not");
}

TEST(ReadTumFrames, NamesARowThatIsWrong) {
  const ImageFolder folder;
  const auto message = [&](const char* list, const std::string& text) {
    return error_of([&] {
      folder.write(list, text);
      read_tum_frames(folder.path());
    });
  };
  const std::string rgb = (folder.path() / "rgb.txt").string(), depth = (folder.path() / "depth.txt").string();
  EXPECT_EQ(message("rgb.txt", "1.0\n"), rgb + ":1: found 1 columns, expected 2: timestamp filename");
  EXPECT_EQ(message("rgb.txt", "x rgb/0.jpg\n"), rgb + ":1: found timestamp 'x', expected a finite number");
  EXPECT_EQ(message("rgb.txt", "1 rgb/0.jpg\n1 rgb/1.jpg\n"),
            rgb + ":2: found timestamp '1', expected later than 1.000000, the time of the row before");
  EXPECT_EQ(message("rgb.txt", "1.0 rgb/0.jpg\n"), depth + ": no such file");
  EXPECT_EQ(message("depth.txt", "1.0 depth/9.png\n"),
            depth + ":1: found file name 'depth/9.png', expected an image that is there; " +
                (folder.path() / "depth/9.png").string() + " is not");
  EXPECT_EQ(message("depth.txt", "2.0 depth/0.png\n1.0 depth/1.png\n"),
            depth + ":2: found timestamp '1.0', expected later than 2.000000, the time of the row before");

  const std::string associations = (folder.path() / "associations.txt").string();
  EXPECT_EQ(message("associations.txt", "1.0 rgb/0.jpg depth/0.png\n"),
            associations + ":1: found 3 columns, expected 4: timestamp rgb_file timestamp depth_file");
  EXPECT_EQ(message("associations.txt", "2.0 rgb/0.jpg 2.0 depth/0.png\n1.5 rgb/1.jpg 1.5 depth/1.png\n"),
            associations + ":2: found timestamp '1.5', expected later than 2.000000, the time of the row before");
  EXPECT_EQ(message("associations.txt", "2.0 rgb/0.jpg nan depth/0.png\n"),
            associations + ":1: found timestamp 'nan', expected a finite number");
  EXPECT_EQ(message("associations.txt", "2.0 rgb 2.0 depth/0.png\n"),
            associations + ":1: found file name 'rgb', expected an image that is there; " +
                (folder.path() / "rgb").string() + " is not");
}

TEST(ReadTumFrames, SequenceWithoutAFrameIsAnError) {
  const ImageFolder folder;
  folder.write("rgb.txt", "1.0 rgb/0.jpg\n");
  folder.write("depth.txt", "1.5 depth/0.png\n1.6 depth/1.png\n");
  EXPECT_EQ(error_of([&] { read_tum_frames(folder.path()); }),
            folder.path().string() +
                ": found no pair among 1 images of rgb.txt and 2 of depth.txt, expected times less "
                "than 0.020 s apart");
  const auto file = folder.write("associations.txt", "# header only\n");
  EXPECT_EQ(error_of([&] { read_tum_frames(folder.path()); }),
            file.string() + ": found no row, expected at least one frame");
}

TEST(ReadTumFrames, FolderThatIsNoneIsAnError) {
  const TemporaryFolder folder;
  const auto missing = folder.path() / "none";
  EXPECT_EQ(error_of([&] { read_tum_frames(missing); }),
            missing.string() + ": no such folder, expected the folder of a TUM sequence");
  const auto file = folder.write("file", "");
  EXPECT_EQ(error_of([&] { read_tum_frames(file); }),
            file.string() + ": not a folder, expected the folder of a TUM sequence");
  EXPECT_EQ(error_of([&] { read_tum_frames(folder.path()); }), (folder.path() / "rgb.txt").string() + ": no such file");
}

}  // namespace
}  // namespace stillpoint
