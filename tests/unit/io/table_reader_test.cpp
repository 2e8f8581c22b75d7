// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/io/table_reader.hpp"

#include <gtest/gtest.h>

#include <string>

#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

#if defined(__unix__)
#include <sys/stat.h>
#endif

namespace stillpoint {
namespace {

#if defined(__unix__)
// Neither has an end, or a beginning: a reader that opened them would hang.
TEST(TableReader, PipesAndDevicesAreNoFiles) {
  const TemporaryFolder folder;
  const std::string pipe = (folder.path() / "pipe").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& file : {pipe, std::string("/dev/zero")})
    EXPECT_EQ(error_of([&] { TableReader{file}; }), file + ": found a pipe or a device, expected a file");
}
#endif

TEST(TableReader, SkipsCommentsAndEmptyRowsAndCountsThem) {
  const TemporaryFolder folder;
  const auto file = folder.write("t.txt", "\xef\xbb\xbf# header\r\n\r\n  \t \n a \t bc\r\n#x\nlast");
  TableReader rows(file);
  ASSERT_TRUE(rows.next_row());
  EXPECT_EQ(rows.position(), file.string() + ":4");
  EXPECT_NO_THROW(rows.require_columns(2, "x y"));
  EXPECT_EQ(rows[0], "a");
  EXPECT_EQ(rows[1], "bc");
  ASSERT_TRUE(rows.next_row());
  EXPECT_EQ(rows.position(), file.string() + ":6");
  EXPECT_EQ(rows[0], "last");
  EXPECT_FALSE(rows.next_row());
  EXPECT_FALSE(rows.next_row());
}

TEST(TableReader, EmptyFileHasNoRow) {
  const TemporaryFolder folder;
  TableReader rows(folder.write("t.txt", ""));
  EXPECT_FALSE(rows.next_row());
}

TEST(TableReader, NamesWhatIsWrongWithARow) {
  const TemporaryFolder folder;
  const auto file = folder.write("t.txt", "1 x nan 1e999\n");
  const std::string where = file.string() + ":1: found ";
  TableReader rows(file);
  ASSERT_TRUE(rows.next_row());
  EXPECT_EQ(rows.number(0, "a"), 1.0);
  EXPECT_EQ(error_of([&] { rows.number(1, "b"); }), where + "b 'x', expected a finite number");
  EXPECT_EQ(error_of([&] { rows.number(2, "c"); }), where + "c 'nan', expected a finite number");
  EXPECT_EQ(error_of([&] { rows.number(3, "d"); }), where + "d '1e999', expected a finite number");
  EXPECT_EQ(error_of([&] { rows.require_columns(3, "a b c"); }), where + "4 columns, expected 3: a b c");
}

TEST(TableReader, ColumnsBetweenCommasMayBeEmpty) {
  const TemporaryFolder folder;
  TableReader rows(folder.write("t.csv", "#a,b\n \r\n, 1 2 ,,x,\r\n,#\n"), TableReader::Columns::between_commas);
  ASSERT_TRUE(rows.next_row());
  ASSERT_EQ(rows.column_count(), 5u);
  EXPECT_EQ(rows[0], "");
  EXPECT_EQ(rows[1], "1 2");
  EXPECT_EQ(rows[2], "");
  EXPECT_EQ(rows[3], "x");
  EXPECT_EQ(rows[4], "");
  ASSERT_TRUE(rows.next_row());
  EXPECT_EQ(rows.column_count(), 2u);
  EXPECT_FALSE(rows.next_row());
}

TEST(TableReader, GarbageInAMessageIsShortAndPrintable) {
  const TemporaryFolder folder;
  TableReader rows(folder.write("t.txt", "\x1b[31m\x07\xff" + std::string(1000, 'x')));
  ASSERT_TRUE(rows.next_row());
  const std::string message = error_of([&] { rows.number(0, "a"); });
  EXPECT_NE(message.find("'?[31m??xxx"), std::string::npos) << message;
  EXPECT_NE(message.find("xxx...'"), std::string::npos) << message;
  EXPECT_LT(message.size(), 300u);
}

TEST(TableReader, TimeMayStandStillUnlessItMustRise) {
  const TemporaryFolder folder;
  const auto file = folder.write("t.txt", "1.5\n1.5\n1.25\n");
  TableReader rows(file);
  double previous_s = TableReader::kBeforeAllTime;
  ASSERT_TRUE(rows.next_row());
  EXPECT_EQ(rows.time(0, previous_s), 1.5);
  ASSERT_TRUE(rows.next_row());
  EXPECT_EQ(error_of([&] { rows.time(0, previous_s, true); }),
            file.string() + ":2: found timestamp '1.5', expected later than 1.500000, the time of the row before");
  EXPECT_EQ(rows.time(0, previous_s), 1.5);
  ASSERT_TRUE(rows.next_row());
  EXPECT_EQ(error_of([&] { rows.time(0, previous_s); }),
            file.string() + ":3: found timestamp '1.25', expected not before 1.500000, the time of the row before");
}

TEST(TableReader, MissingFileAndFolderAreNamed) {
  const TemporaryFolder folder;
  const auto missing = folder.path() / "t.txt";
  EXPECT_EQ(error_of([&] { TableReader{missing}; }), missing.string() + ": no such file");
  EXPECT_EQ(error_of([&] { TableReader{folder.path()}; }),
            folder.path().string() + ": found a folder, expected a file");
}

}  // namespace
}  // namespace stillpoint
