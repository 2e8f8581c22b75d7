// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/mobility_table.hpp"

#include <gtest/gtest.h>

namespace stillpoint {
namespace {

TEST(MobilityTable, SortsThePapersExamples) {
  const MobilityTable table;
  for (const char* name : {"person", "car", "dog", "bus"}) EXPECT_EQ(table[name], Mobility::dynamic) << name;
  for (const char* name : {"chair", "mouse", "bottle"}) EXPECT_EQ(table[name], Mobility::movable) << name;
  for (const char* name : {"wall", "tv", "table"}) EXPECT_EQ(table[name], Mobility::fixed) << name;
}

TEST(MobilityTable, KnowsEveryClassOfCoco) {
  const MobilityTable table;
  for (const char* name : {"person",        "bicycle",      "car",
                           "motorcycle",    "airplane",     "bus",
                           "train",         "truck",        "boat",
                           "traffic light", "fire hydrant", "stop sign",
                           "parking meter", "bench",        "bird",
                           "cat",           "dog",          "horse",
                           "sheep",         "cow",          "elephant",
                           "bear",          "zebra",        "giraffe",
                           "backpack",      "umbrella",     "handbag",
                           "tie",           "suitcase",     "frisbee",
                           "skis",          "snowboard",    "sports ball",
                           "kite",          "baseball bat", "baseball glove",
                           "skateboard",    "surfboard",    "tennis racket",
                           "bottle",        "wine glass",   "cup",
                           "fork",          "knife",        "spoon",
                           "bowl",          "banana",       "apple",
                           "sandwich",      "orange",       "broccoli",
                           "carrot",        "hot dog",      "pizza",
                           "donut",         "cake",         "chair",
                           "couch",         "potted plant", "bed",
                           "dining table",  "toilet",       "tv",
                           "laptop",        "mouse",        "remote",
                           "keyboard",      "cell phone",   "microwave",
                           "oven",          "toaster",      "sink",
                           "refrigerator",  "book",         "clock",
                           "vase",          "scissors",     "teddy bear",
                           "hair drier",    "toothbrush"})
    EXPECT_NE(table[name], Mobility::unknown) << name;
}

TEST(MobilityTable, AnUnknownClassSaysNothing) {
  const MobilityTable table;
  EXPECT_EQ(table["unicorn"], Mobility::unknown);
  EXPECT_EQ(table[""], Mobility::unknown);
  EXPECT_EQ(table["Person"], Mobility::unknown) << "names are compared as they are";
  EXPECT_EQ(table["perso"], Mobility::unknown);
}

TEST(MobilityTable, UnderscoreAndSpaceAreAlike) {
  MobilityTable table;
  EXPECT_EQ(table["dining_table"], Mobility::fixed);
  EXPECT_EQ(table["teddy_bear"], Mobility::movable);
  table.set("robot_arm", Mobility::dynamic);
  EXPECT_EQ(table["robot arm"], Mobility::dynamic);
}

TEST(MobilityTable, TheUserChangesIt) {
  MobilityTable table;
  table.set("chair", Mobility::dynamic);
  EXPECT_EQ(table["chair"], Mobility::dynamic);
  table.set("chair", Mobility::unknown);
  EXPECT_EQ(table["chair"], Mobility::unknown);
  EXPECT_EQ(MobilityTable()["chair"], Mobility::movable) << "one table does not change another";
}

}  // namespace
}  // namespace stillpoint
