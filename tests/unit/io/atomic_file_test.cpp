// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/io/atomic_file.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <string>

#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

#if defined(__unix__)
#include <sys/resource.h>
#include <sys/stat.h>
#endif

namespace stillpoint {
namespace {

TEST(AtomicFile, AppearsWhenItIsCommitted) {
  const TemporaryFolder folder;
  const auto target = folder.path() / "out.txt";
  AtomicFile file(target);
  file.write("one\n").write("two\n");
  EXPECT_FALSE(std::filesystem::exists(target));
  file.commit();
  EXPECT_EQ(TemporaryFolder::read(target), "one\ntwo\n");
  EXPECT_EQ(folder.count_files(), 1);
}

TEST(AtomicFile, WithoutCommitTheOldFileStaysAndNothingIsLeft) {
  const TemporaryFolder folder;
  const auto target = folder.write("out.txt", "old");
  {
    AtomicFile file(target);
    file.write("half");
    EXPECT_EQ(folder.count_files(), 2);
  }
  EXPECT_EQ(TemporaryFolder::read(target), "old");
  EXPECT_EQ(folder.count_files(), 1);
}

TEST(AtomicFile, ReplacesAnOlderFile) {
  const TemporaryFolder folder;
  const auto target = folder.write("out.txt", "a much longer old file");
  AtomicFile file(target);
  file.write("new");
  file.commit();
  EXPECT_EQ(TemporaryFolder::read(target), "new");
}

TEST(AtomicFile, AFinishedFileIsWholeAndHasNoNameYet) {
  const TemporaryFolder folder;
  const auto target = folder.write("out.txt", "old");
  {
    AtomicFile file(target);
    file.write("new");
    file.finish();
    EXPECT_EQ(TemporaryFolder::read(folder.path() / "out.txt.partial0"), "new");
    EXPECT_EQ(TemporaryFolder::read(target), "old");
  }
  EXPECT_EQ(folder.count_files(), 1) << "without commit";
  AtomicFile file(target);
  file.write("new");
  file.finish();
  file.commit();
  EXPECT_EQ(TemporaryFolder::read(target), "new");
  EXPECT_EQ(folder.count_files(), 1);
}

TEST(AtomicFile, WritesThroughASymbolicLink) {
  const TemporaryFolder folder;
  const auto real = folder.write("real.txt", "old"), link = folder.path() / "link.txt";
  std::filesystem::create_symlink("real.txt", link);
  AtomicFile file(link);
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(TemporaryFolder::read(real), "new");
  EXPECT_EQ(folder.count_files(), 2);
}

TEST(AtomicFile, MakesTheFileThatASymbolicLinkNames) {
  const TemporaryFolder folder;
  const auto real = folder.path() / "below" / "real.txt", link = folder.path() / "link.txt";
  std::filesystem::create_directory(folder.path() / "below");
  std::filesystem::create_symlink("below/next.txt", link);
  std::filesystem::create_symlink("real.txt", folder.path() / "below" / "next.txt");
  AtomicFile file(link);
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "below" / "next.txt"));
  ASSERT_TRUE(std::filesystem::exists(real));
  EXPECT_EQ(TemporaryFolder::read(real), "new");
}

TEST(AtomicFile, SymbolicLinksInACircleAreNamed) {
  const TemporaryFolder folder;
  const auto link = folder.path() / "link.txt";
  std::filesystem::create_symlink("other.txt", link);
  std::filesystem::create_symlink("link.txt", folder.path() / "other.txt");
  EXPECT_EQ(error_of([&] { AtomicFile file(link); }),
            link.string() + ": found a symbolic link that leads to no file, expected a file to write");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

#if defined(__unix__)
TEST(AtomicFile, APipeIsNoFileToReplace) {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(error_of([&] { AtomicFile file(pipe); }),
            pipe.string() + ": found a device or a pipe, expected a file to write");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_EQ(error_of([] { AtomicFile file("/dev/null"); }),
            "/dev/null: found a device or a pipe, expected a file to write");
}
#endif

TEST(AtomicFile, TwoWritersOfOneTargetDoNotMix) {
  const TemporaryFolder folder;
  const auto target = folder.path() / "out.txt";
  AtomicFile first(target), second(target);
  first.write("first");
  second.write("second");
  second.commit();
  EXPECT_EQ(TemporaryFolder::read(target), "second");
  first.commit();
  EXPECT_EQ(TemporaryFolder::read(target), "first");
  EXPECT_EQ(folder.count_files(), 1);
}

TEST(AtomicFile, WhatDeadProcessesLeftIsNotInTheWay) {
  const TemporaryFolder folder;
  const auto target = folder.path() / "out.txt";
  for (int i = 0; i < 120; ++i) folder.write("out.txt.partial" + std::to_string(i), "of another");
  AtomicFile file(target);
  file.write("whole");
  file.commit();
  EXPECT_EQ(TemporaryFolder::read(target), "whole");
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "out.txt.partial7"), "of another");
}

TEST(AtomicFile, BytesAreWrittenAsTheyAre) {
  const TemporaryFolder folder;
  const auto target = folder.path() / "out.bin";
  const std::string bytes("\r\n\0\xff\n", 5);
  AtomicFile file(target);
  file.write(bytes);
  file.commit();
  EXPECT_EQ(TemporaryFolder::read(target), bytes);
}

TEST(AtomicFile, FolderThatIsNotThereIsNamed) {
  const TemporaryFolder folder;
  const auto target = folder.path() / "none" / "out.txt";
  EXPECT_EQ(error_of([&] { AtomicFile{target}; }),
            target.string() + ": cannot make out.txt.partial0 beside it: No such file or directory");
  const auto below_file = folder.write("file", "") / "out.txt";
  EXPECT_EQ(error_of([&] { AtomicFile{below_file}; }),
            below_file.string() + ": cannot make out.txt.partial0 beside it: Not a directory");
  EXPECT_EQ(error_of([&] { AtomicFile{folder.path()}; }),
            folder.path().string() + ": found a folder, expected a file to write");
}

TEST(AtomicFile, NameThatCannotBeGivenIsAnErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  const auto target = folder.path() / "out.txt";
  AtomicFile file(target);
  file.write("text");
  std::filesystem::create_directory(target);  // after the constructor's check
  const std::string message = error_of([&] { file.commit(); });
  EXPECT_EQ(message.find(target.string() + ": cannot rename out.txt.partial0: "), 0u) << message;
  EXPECT_EQ(folder.count_files(), 1);
}

TEST(AtomicFile, WritingAfterCommitIsAnError) {
  const TemporaryFolder folder;
  AtomicFile file(folder.path() / "out.txt");
  file.commit();
  EXPECT_NE(error_of([&] { file.write("more"); }).find("is finished already"), std::string::npos);
  EXPECT_NE(error_of([&] { file.commit(); }).find("is finished already"), std::string::npos);
}

#if defined(__unix__)
/// A limit on the size of files stands for a full disk: both make write() fail after some bytes.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    rlimit limit = old_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  void (*old_handler_)(int);
  rlimit old_ = {};
};

TEST(AtomicFile, FullDiskIsAnErrorAndTheOldFileStays) {
  const TemporaryFolder folder;
  const auto target = folder.write("out.txt", "old");
  // 5000 bytes stay in the buffer's hands until commit on some systems; 100000 do not.
  for (const std::size_t bytes : {std::size_t{5000}, std::size_t{100000}}) {
    std::string message;
    {
      const FileSizeLimit limit(4096);
      message = error_of([&] {
        AtomicFile file(target);
        file.write(std::string(bytes, 'x'));
        file.commit();
      });
    }
    EXPECT_EQ(message, target.string() + ": cannot write: File too large");
    EXPECT_EQ(TemporaryFolder::read(target), "old");
    EXPECT_EQ(folder.count_files(), 1);
  }
}

TEST(AtomicFile, FullDiskFoundAtCommitIsAnError) {
  const TemporaryFolder folder;
  const auto target = folder.path() / "out.txt";
  AtomicFile file(target);
  file.write("few bytes stay in the buffer");
  std::string message;
  {
    const FileSizeLimit limit(0);
    message = error_of([&] { file.commit(); });
  }
  EXPECT_EQ(message, target.string() + ": cannot write: File too large");
  EXPECT_EQ(folder.count_files(), 0);
}
#endif

}  // namespace
}  // namespace stillpoint
