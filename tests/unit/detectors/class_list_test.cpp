// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/class_list.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "stillpoint/core/regions.hpp"
#include "stillpoint/detectors/mobility_table.hpp"
#include "unit/detectors/made_tensor.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

TEST(ClassList, ListsOfTheLibrary) {
  EXPECT_EQ(ClassList::coco().size(), 80u);
  EXPECT_EQ(ClassList::coco()[0], "person");
  EXPECT_EQ(ClassList::coco()[56], "chair");
  EXPECT_EQ(ClassList::coco()[79], "toothbrush");
  EXPECT_EQ(ClassList::coco91().size(), 91u);
  EXPECT_EQ(ClassList::coco91()[1], "person");
  EXPECT_EQ(ClassList::coco91()[62], "chair");
  EXPECT_EQ(ClassList::coco91()[90], "toothbrush");
  EXPECT_EQ(ClassList::voc().size(), 20u);
  EXPECT_EQ(ClassList::voc()[14], "person");
  EXPECT_EQ(ClassList::voc21()[15], "person");
  EXPECT_EQ(ClassList::cityscapes().size(), 19u);
  EXPECT_EQ(ClassList::cityscapes()[11], "person");
}

TEST(ClassList, BackgroundAndGapsAreNoClasses) {
  const ClassList coco91 = ClassList::coco91();
  EXPECT_TRUE(coco91.starts_with_background());
  EXPECT_FALSE(coco91.names(0));
  EXPECT_TRUE(coco91.names(1));
  EXPECT_FALSE(coco91.names(12));
  EXPECT_FALSE(coco91.names(91));
  EXPECT_FALSE(coco91.names(-1));
  EXPECT_FALSE(ClassList::coco().starts_with_background());
  EXPECT_TRUE(ClassList::coco().names(0));
}

TEST(ClassList, TheTableOfMobilityKnowsAllOfCocoAndVoc) {
  const MobilityTable table;
  for (const ClassList& list : {ClassList::coco(), ClassList::voc()})
    for (std::size_t i = 0; i < list.size(); ++i) EXPECT_NE(table[list[i]], Mobility::unknown) << list[i];
}

TEST(ClassList, WhoMovesInCityscapesIsKnown) {
  const MobilityTable table;
  const ClassList list = ClassList::cityscapes();
  for (std::size_t i = 11; i < 19; ++i) EXPECT_EQ(table[list[i]], Mobility::dynamic) << list[i];
}

TEST(ClassList, OneNameALine) {
  const TemporaryFolder folder;
  const ClassList list =
      ClassList::read(folder.write("my.names", "\xef\xbb\xbfperson\r\n  traffic light \n???\ncar\n\n\n"));
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[0], "person");
  EXPECT_EQ(list[1], "traffic light");
  EXPECT_FALSE(list.names(2));
  EXPECT_EQ(list[3], "car");
}

TEST(ClassList, NamedIsAListOrAFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(ClassList::named("coco").size(), 80u);
  EXPECT_EQ(ClassList::named("voc21").size(), 21u);
  EXPECT_EQ(ClassList::named(folder.write("my.names", "thing").string())[0], "thing");
}

TEST(ClassList, ErrorsNameFileAndLine) {
  const TemporaryFolder folder;
  const auto error = [&folder](const std::string& text) {
    const fs::path file = folder.write("my.names", text);
    const std::string message = error_of([&] { ClassList::read(file); });
    EXPECT_EQ(message.find(file.string()), 0u) << message;
    return message.substr(std::min(file.string().size(), message.size()));
  };
  EXPECT_EQ(error("person\n\ncar\n"), ":2: found a blank line, expected a class name (??? where a number has none)");
  EXPECT_EQ(error(""), ": found no name, expected one class name a line");
  EXPECT_EQ(error("\n\n"), ": found no name, expected one class name a line");
  EXPECT_EQ(error(std::string("person\nc\0r\n", 11)),
            ":2: found something else than a class name, expected one name a line");
  EXPECT_EQ(error(std::string(300, 'x')), ":1: found something else than a class name, expected one name a line");
  EXPECT_EQ(error_of([] { ClassList::read("/no/such/names"); }), "/no/such/names: no such file");
  expect_contains(error_of([] { ClassList::read(testing::TempDir()); }), "found a folder, expected a file");
}

}  // namespace
}  // namespace stillpoint
