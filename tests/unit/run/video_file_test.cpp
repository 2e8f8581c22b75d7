// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A video is read back before it gets its name.

#include "run/video_file.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

#include <cstdint>
#include <filesystem>

#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint_run::video_file_test {
namespace {

class VideoFileTest : public testing::Test {
 protected:
  VideoFileTest() { cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); }

  /// Frames of noise: none of them is small.
  static void write(VideoFile& video, int frames) {
    cv::RNG random(1);
    cv::Mat picture(96, 128, CV_8UC3);
    for (int i = 0; i < frames; ++i) {
      random.fill(picture, cv::RNG::UNIFORM, 0, 255);
      video.write(picture, 0.1 * i);
    }
  }

  void expect_written_through_link_to(const std::filesystem::path& named) const {
    std::filesystem::create_symlink(named, file);
    VideoFile video(file);
    write(video, 2);
    video.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(file));
    EXPECT_EQ(count_frames(named), 2u);
  }

  stillpoint::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "video.avi";
};

TEST_F(VideoFileTest, HasTheFramesThatWereWritten) {
  for (const int frames : {1, 2, 7}) {
    VideoFile video(file);
    write(video, frames);
    video.commit();
    EXPECT_EQ(count_frames(file), static_cast<std::size_t>(frames));
    EXPECT_TRUE(states_its_size(file));
    EXPECT_EQ(folder.count_files(), 1);
  }
}

TEST_F(VideoFileTest, WhatBreaksOffIsNoticed) {
  VideoFile video(file);
  write(video, 7);
  video.commit();
  const std::uintmax_t size = std::filesystem::file_size(file);
  std::filesystem::resize_file(file, size - 1);
  EXPECT_FALSE(states_its_size(file));
  std::filesystem::resize_file(file, size / 2);
  EXPECT_LT(count_frames(file), 7u);
  std::filesystem::resize_file(file, 0);
  EXPECT_EQ(count_frames(file), 0u);
  EXPECT_FALSE(states_its_size(file));
  EXPECT_EQ(count_frames(folder.path() / "none.avi"), 0u);
}

// The temporary file is lost as on a disk that takes nothing.
TEST_F(VideoFileTest, ALostFileIsAnErrorAndLeavesNothing) {
  const std::filesystem::path partial = folder.path() / "video.partial0.avi";
  {
    VideoFile video(file);
    write(video, 3);
    ASSERT_TRUE(std::filesystem::remove(partial));
    EXPECT_EQ(stillpoint::error_of([&] { video.commit(); }),
              file.string() +
                  ": cannot write the video: found 0 frames in the file, which breaks off; expected the 3 that were "
                  "written (is the disk full?)");
  }
  EXPECT_EQ(folder.count_files(), 0);
}

TEST_F(VideoFileTest, WhatIsNoFileIsRefusedBeforeTheFirstFrame) {
  std::filesystem::create_directory(file);
  EXPECT_EQ(stillpoint::error_of([&] { const VideoFile video(file); }),
            "--save-video: found " + file.string() + ", which is a folder, expected a file to write");
  const std::filesystem::path nowhere = folder.path() / "none" / "video.avi";
  EXPECT_EQ(stillpoint::error_of([&] { const VideoFile video(nowhere); }),
            "--save-video: found " + nowhere.string() + ", expected a folder that is there");
  EXPECT_EQ(folder.count_files(), 1);
}

TEST_F(VideoFileTest, APartialFileOfSomebodyElseStays) {
  folder.write("video.partial0.avi", "of another");
  {
    VideoFile video(file);
    write(video, 2);
    video.commit();
  }
  EXPECT_EQ(count_frames(file), 2u);
  EXPECT_EQ(stillpoint::TemporaryFolder::read(folder.path() / "video.partial0.avi"), "of another");
  EXPECT_EQ(folder.count_files(), 2);
}

TEST_F(VideoFileTest, OfALinkTheFileThatItNamesIsWritten) {
  expect_written_through_link_to(folder.write("named", "old"));
}

TEST_F(VideoFileTest, OfALinkTheFileThatIsMissingIsMade) { expect_written_through_link_to(folder.path() / "named"); }

}  // namespace
}  // namespace stillpoint_run::video_file_test
