// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/io/image_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint {
namespace {

class ImageFolderTest : public testing::Test {
 protected:
  /// The reader looks at names alone: the files may be anything.
  void write(const std::vector<std::string>& names, const std::string& below = "left") {
    for (const std::string& name : names) folder.write(below + '/' + name, "anything");
  }
  std::vector<std::string> names_of(const ImageList& list) {
    std::vector<std::string> names;
    for (const TimedImage& image : list.images) names.push_back(image.file.filename().string());
    return names;
  }
  std::string message() {
    return error_of([&] { read_image_folder(left); });
  }

  TemporaryFolder folder;
  const std::filesystem::path left = folder.path() / "left", right = folder.path() / "right";
};

TEST_F(ImageFolderTest, OrderIsThatOfPeopleWhoCount) {
  write({"image_10.png", "image_9.jpg", "image_9b.png", "image_010.JPEG", "image_1.Png", "readme.txt", "image_2"});
  std::filesystem::create_directory(left / "image_3.png");
  const ImageList list = read_image_folder(left);
  EXPECT_EQ(names_of(list),
            (std::vector<std::string>{"image_1.Png", "image_9.jpg", "image_9b.png", "image_010.JPEG", "image_10.png"}));
}

// A strict weak order, or std::sort may do anything: of every three names, and every two.
TEST_F(ImageFolderTest, NaturalOrderIsAnOrder) {
  const std::vector<std::string> names = {"",  "a", "a1", "a01", "a10", "a2", "a2b",
                                          "b", "0", "00", "1",   "01a", "1a", "10"};
  for (const std::string& a : names) {
    EXPECT_FALSE(detail::naturally_less(a, a)) << a;
    for (const std::string& b : names) {
      const bool a_first = detail::naturally_less(a, b);
      EXPECT_TRUE(a == b || a_first != detail::naturally_less(b, a)) << a << ' ' << b;
      for (const std::string& c : names)
        EXPECT_TRUE(!a_first || !detail::naturally_less(b, c) || detail::naturally_less(a, c))
            << a << ' ' << b << ' ' << c;
    }
  }
  EXPECT_TRUE(detail::naturally_less("a2", "a10"));
  EXPECT_TRUE(
      detail::naturally_less("a99999999999999999999998", "a99999999999999999999999"));  // no integer holds these
}

TEST_F(ImageFolderTest, CountersAreNoTimes) {
  write({"000007.png", "000008.png", "000010.png"});
  const ImageList list = read_image_folder(left);
  EXPECT_TRUE(list.rate_is_assumed);
  EXPECT_EQ(list.images[0].timestamp_s, 0.0);
  EXPECT_EQ(list.images[2].timestamp_s, 2.0 / 30.0);
}

TEST_F(ImageFolderTest, TimesAreReadFromNames) {
  write({"1305031102.175304.png", "1305031102.211214.png"});
  EXPECT_EQ(read_image_folder(left).images[1].timestamp_s, 1305031102.211214);
  EXPECT_FALSE(read_image_folder(left).rate_is_assumed);
  // A nanosecond is a 2e-7th of what a double of this size resolves.
  EXPECT_NEAR(*detail::time_of_name("1403636579763555584.png"), 1403636579.763555584, 1e-6);
  EXPECT_NEAR(*detail::time_of_name("1403636579763555.png"), 1403636579.763555, 1e-6);
  EXPECT_NEAR(*detail::time_of_name("1403636579763.png"), 1403636579.763, 1e-6);
  for (const char* none : {"a1.5.png", "1.5a.png", "1e5.0.png", "-1.5.png", "1.2.3.png", "12345678901234.png", ".5.png",
                           "0000000000001.png", "0000000000000000001.png"})
    EXPECT_FALSE(detail::time_of_name(none)) << none;
}

// Python's f"{time.time()}.png" leaves out zeros at the end: .3 is later than .252.
TEST_F(ImageFolderTest, NamesThatTellTheTimeAreInItsOrder) {
  const std::vector<std::string> names = {"1700000000.051.png", "1700000000.102.png", "1700000000.15.png",
                                          "1700000000.201.png", "1700000000.252.png", "1700000000.3.png",
                                          "1700000001.0.png",   "1700000010.05.png"};
  write(names);
  EXPECT_EQ(message(), "no error");
  EXPECT_EQ(names_of(read_image_folder(left)), names);
  EXPECT_EQ(read_image_folder(left).images[5].timestamp_s, 1700000000.3);
  const ImageList by_rate = read_image_folder(left, 20.0);
  EXPECT_EQ(names_of(by_rate), names);
  EXPECT_EQ(by_rate.images[2].timestamp_s, 0.1);

  write(names, "right");
  const auto frames = pair_with_right_folder(read_image_folder(left), right);
  ASSERT_EQ(frames.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(frames[i].left_file, left / names[i]);
    EXPECT_EQ(frames[i].right_file, right / names[i]);
  }
  EXPECT_EQ(frames[5].timestamp_s, 1700000000.3);
  write({"right_of_nothing.png"}, "right");
  EXPECT_EQ(error_of([&] { pair_with_right_folder(read_image_folder(left), right); }),
            (right / "right_of_nothing.png").string() +
                ": found no image of this name in the folder of the left camera, expected the same names in both");
}

// macOS puts ._0000.png beside 0000.png on disks of other systems.
TEST_F(ImageFolderTest, HiddenFilesAreNoImages) {
  write({"0000.png", "._0000.png", "0001.png", "._0001.png", ".thumbnail.jpg"});
  EXPECT_EQ(names_of(read_image_folder(left)), (std::vector<std::string>{"0000.png", "0001.png"}));
  write({"0000.png", "0001.png"}, "right");
  EXPECT_EQ(error_of([&] { EXPECT_EQ(pair_with_right_folder(read_image_folder(left), right).size(), 2u); }),
            "no error");
}

TEST_F(ImageFolderTest, OneNameWithoutATimeTakesItFromAll) {
  write({"1.5.png", "1.6.png", "last.png"});
  const ImageList list = read_image_folder(left);
  EXPECT_TRUE(list.rate_is_assumed);
  EXPECT_EQ(list.images[1].timestamp_s, 1.0 / 30.0);
}

TEST_F(ImageFolderTest, ARateOfTheCallersGoesBeforeNames) {
  write({"1.5.png", "1.6.png"});
  const ImageList list = read_image_folder(left, 4.0);
  EXPECT_FALSE(list.rate_is_assumed);
  EXPECT_EQ(list.images[1].timestamp_s, 0.25);
  EXPECT_EQ(error_of([&] { read_image_folder(left, 0.0); }),
            "frame rate: found 0, expected a positive number of images per second");
  EXPECT_EQ(error_of([&] { read_image_folder(left, std::numeric_limits<double>::infinity()); }),
            "frame rate: found inf, expected a positive number of images per second");
}

TEST_F(ImageFolderTest, WhatIsNoFolderOfImagesIsNamed) {
  EXPECT_EQ(message(), left.string() + ": no such folder, expected a folder of images");
  write({"notes.txt"});
  EXPECT_EQ(message(), left.string() +
                           ": found no image, expected files named .png, .jpg, .jpeg, .bmp, .tif, .tiff, .pgm, .ppm or "
                           ".webp");
  EXPECT_EQ(error_of([&] { read_image_folder(left / "notes.txt"); }),
            (left / "notes.txt").string() + ": not a folder, expected a folder of images");
}

TEST_F(ImageFolderTest, TwoImagesOfOneTimeAreNamed) {
  write({"1.5.png", "1.50.png"});
  EXPECT_EQ(message(), (left / "1.50.png").string() +
                           ": found the time 1.500000 s in its name, expected one later than that of 1.5.png");
}

TEST_F(ImageFolderTest, PairsHaveEqualNames) {
  write({"1.png", "2.png"});
  write({"1.png", "2.png", "calib.txt"}, "right");
  const auto frames = pair_with_right_folder(read_image_folder(left, 10.0), right);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].timestamp_s, 0.1);
  EXPECT_EQ(frames[1].left_file, left / "2.png");
  EXPECT_EQ(frames[1].right_file, right / "2.png");
}

TEST_F(ImageFolderTest, ImagesThatAreAloneAreNamed) {
  write({"1.png", "2.png", "3.png"});
  write({"1.png", "3.png", "4.png"}, "right");
  const auto alone = [&] { return error_of([&] { pair_with_right_folder(read_image_folder(left), right); }); };
  EXPECT_EQ(alone(),
            (left / "2.png").string() +
                ": found no image of this name in the folder of the right camera, expected the same names in both");
  write({"2.png"}, "right");
  EXPECT_EQ(alone(),
            (right / "4.png").string() +
                ": found no image of this name in the folder of the left camera, expected the same names in both");
}

}  // namespace
}  // namespace stillpoint
