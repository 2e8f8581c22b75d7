// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Runs stillpoint_run as a user does, in a folder that goes away afterwards.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace system_test {

namespace fs = std::filesystem;

/// An empty folder that is removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "stillpoint_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder: " + name);
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  fs::path operator/(const fs::path& name) const { return path_ / name; }

 private:
  fs::path path_;
};

inline std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void write_text(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

struct Outcome {
  int status = -1;
  std::string out, error;
};

/// Runs the program with arguments that the shell reads.
/// @param before  commands of the shell that runs it, each with its semicolon
inline Outcome run_program(const std::string& arguments, const std::string& before = "") {
  const TemporaryFolder folder;
  const std::string command = before + "\"" + STILLPOINT_RUN_PROGRAM + "\" " + arguments + " > \"" +
                              (folder / "out").string() + "\" 2> \"" + (folder / "error").string() + "\"";
  Outcome outcome;
  const int code = std::system(command.c_str());
  outcome.status = WIFEXITED(code) ? WEXITSTATUS(code) : -1;
  outcome.out = read_text(folder / "out");
  outcome.error = read_text(folder / "error");
  return outcome;
}

inline std::string quoted(const fs::path& path) { return '"' + path.string() + '"'; }

/// Expects exit status 2 and one line on standard error that holds each of the texts.
inline void expect_error(const std::string& arguments, const std::vector<std::string>& texts,
                         const std::string& before = "") {
  const Outcome outcome = run_program(arguments, before);
  EXPECT_EQ(outcome.status, 2) << arguments << '\n' << outcome.error;
  EXPECT_TRUE(outcome.out.empty()) << arguments << '\n' << outcome.out;
  EXPECT_EQ(outcome.error.find('\n'), outcome.error.size() - 1) << arguments << '\n' << outcome.error;
  EXPECT_EQ(outcome.error.rfind("stillpoint_run: ", 0), 0u) << outcome.error;
  for (const std::string& text : texts)
    EXPECT_NE(outcome.error.find(text), std::string::npos)
        << arguments << "\nexpected: " << text << "\nfound:    " << outcome.error;
}

inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// Rows of a CSV file, the first the header's.
inline std::vector<std::vector<std::string>> read_csv(const fs::path& file) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : split(read_text(file), '\n')) rows.push_back(split(line, ','));
  return rows;
}

inline std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace system_test
