// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Boxes by their centres, classes by name and by number.

#include "stillpoint_ros/detections.hpp"

#include <gtest/gtest.h>

namespace stillpoint_ros::detections_test {

TEST(Detections, ABoxHasItsCornerHalfASizeFromItsCentre) {
  const stillpoint::Detection detection = detection_of({"person", 0.75, 100, 50, 40, 20}, ClassNames());
  EXPECT_EQ(detection.box.x, 80);
  EXPECT_EQ(detection.box.y, 40);
  EXPECT_EQ(detection.box.width, 40);
  EXPECT_EQ(detection.box.height, 20);
  EXPECT_EQ(detection.confidence, 0.75f);
  EXPECT_EQ(detection.mobility, stillpoint::Mobility::dynamic);
}

TEST(Detections, ANumberIsLookedUpInTheListOfClasses) {
  ClassNames names;
  EXPECT_EQ(names.name_of("0"), "person");
  EXPECT_EQ(names.name_of("chair"), "chair");
  EXPECT_EQ(names.name_of("80"), "80") << "COCO has 80 classes";
  EXPECT_EQ(names.name_of(""), "");
  EXPECT_EQ(names.name_of("123456789012"), "123456789012");
  EXPECT_EQ(detection_of({"56", 1, 0, 0, 1, 1}, names).mobility, stillpoint::Mobility::movable) << "a chair";
  names.classes = stillpoint::ClassList::voc();
  EXPECT_EQ(names.name_of("14"), "person");
}

TEST(Detections, ANameOfTheListHasItsNumber) {
  EXPECT_EQ(detection_of({"chair", 1, 0, 0, 1, 1}, ClassNames()).class_index, 56);
  EXPECT_EQ(detection_of({"56", 1, 0, 0, 1, 1}, ClassNames()).class_index, 56);
  EXPECT_EQ(detection_of({"traffic_light", 1, 0, 0, 1, 1}, ClassNames()).class_index, 9) << "COCO's \"traffic light\"";
  for (const char* none : {"", "80", "unicorn", "123456789012"})
    EXPECT_EQ(detection_of({none, 1, 0, 0, 1, 1}, ClassNames()).class_index, -1) << none;
}

TEST(Detections, AnUnknownClassSaysNothing) {
  EXPECT_EQ(detection_of({"unicorn", 1, 0, 0, 1, 1}, ClassNames()).mobility, stillpoint::Mobility::unknown);
}

}  // namespace stillpoint_ros::detections_test
