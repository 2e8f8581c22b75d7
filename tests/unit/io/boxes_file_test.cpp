// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/io/boxes_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint::boxes_file_test {
namespace {

const std::string kHeader = "# timestamp class_name confidence x y w h\n";

/// What the reader says of the row after the header, without the file's name.
std::string message_of_row(const std::string& row) {
  const TemporaryFolder folder;
  const auto file = folder.write("boxes.txt", kHeader + row + "\n");
  const std::string message = error_of([&] { read_boxes(file); });
  const std::string where = file.string() + ":2: found ";
  EXPECT_EQ(message.substr(0, where.size()), where) << message;
  return message.size() > where.size() ? message.substr(where.size()) : "";
}

TEST(ReadBoxes, GroupsTheRowsOfATime) {
  const TemporaryFolder folder;
  const auto frames = read_boxes(folder.write(
      "boxes.txt", kHeader + "1.0 person 0.84 271 -3 141 209\n1.0 dining_table 0.5 1.5 2 3 4\n1.1 cup 1 0 0 1 1\n"));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].timestamp_s, 1.0);
  ASSERT_EQ(frames[0].boxes.size(), 2u);
  const DetectedBox& person = frames[0].boxes[0];
  EXPECT_EQ(person.class_name, "person");
  EXPECT_EQ(person.confidence, 0.84f);
  EXPECT_EQ(person.box.x, 271.0f);
  EXPECT_EQ(person.box.y, -3.0f);
  EXPECT_EQ(person.box.width, 141.0f);
  EXPECT_EQ(person.box.height, 209.0f);
  EXPECT_EQ(frames[0].boxes[1].class_name, "dining table");
  ASSERT_EQ(frames[1].boxes.size(), 1u);
}

TEST(ReadBoxes, HeaderOnlyMeansThatNothingWasDetected) {
  const TemporaryFolder folder;
  EXPECT_TRUE(read_boxes(folder.write("boxes.txt", kHeader)).empty());
}

TEST(ReadBoxes, MissingFileIsAnError) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "boxes.txt";
  EXPECT_EQ(error_of([&] { read_boxes(file); }), file.string() + ": no such file");
}

TEST(ReadBoxes, NamesWhatIsWrong) {
  EXPECT_EQ(message_of_row("1 dining table 0.5 0 0 1 1"),
            "8 columns, expected 7: timestamp class_name confidence x y w h");
  EXPECT_EQ(message_of_row("x person 0.5 0 0 1 1"), "timestamp 'x', expected a finite number");
  EXPECT_EQ(message_of_row("1 person 1.01 0 0 1 1"), "confidence '1.01', expected a number from 0 to 1");
  EXPECT_EQ(message_of_row("1 person -0.1 0 0 1 1"), "confidence '-0.1', expected a number from 0 to 1");
  EXPECT_EQ(message_of_row("1 person nan 0 0 1 1"), "confidence 'nan', expected a finite number");
  EXPECT_EQ(message_of_row("1 person 0.5 nan 0 1 1"), "x 'nan', expected a finite number");
  EXPECT_EQ(message_of_row("1 person 0.5 0 1e30 1 1"), "y '1e30', expected a number of pixels of at most a million");
  EXPECT_EQ(message_of_row("1 person 0.5 0 0 0 1"), "w '0', expected a positive number of pixels");
  EXPECT_EQ(message_of_row("1 person 0.5 0 0 1 -4"), "h '-4', expected a positive number of pixels");
  EXPECT_EQ(message_of_row("1 person 0.5 0 0 1e-60 4"), "w '1e-60', expected a positive number of pixels");
}

TEST(ReadBoxes, TimeRunningBackwardsIsAnError) {
  const TemporaryFolder folder;
  const auto file = folder.write("boxes.txt", "2 person 0.5 0 0 1 1\n1 person 0.5 0 0 1 1\n");
  EXPECT_EQ(error_of([&] { read_boxes(file); }),
            file.string() + ":2: found timestamp '1', expected not before 2.000000, the time of the row before");
}

TEST(BoxesAt, FindsTheNearestWithinTheTolerance) {
  const std::vector<FrameBoxes> frames = {{1.0, {}}, {1.0008, {}}, {2.0, {}}};
  EXPECT_EQ(boxes_at(frames, 1.0), &frames[0]);
  EXPECT_EQ(boxes_at(frames, 1.0006), &frames[1]);
  EXPECT_EQ(boxes_at(frames, 1.9995), &frames[2]);
  EXPECT_EQ(boxes_at(frames, 1.5), nullptr);
  EXPECT_EQ(boxes_at(frames, 2.5), nullptr);
  EXPECT_EQ(boxes_at(frames, 1.5, 0.6), &frames[1]);
  EXPECT_EQ(boxes_at({}, 1.0), nullptr);
}

}  // namespace
}  // namespace stillpoint::boxes_file_test
