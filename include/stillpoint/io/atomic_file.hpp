// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Output files that are whole or not there.

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "stillpoint/core/error.hpp"
#include "stillpoint/io/target_file.hpp"

namespace stillpoint {

/// Writes to a temporary file beside the target ("report.json.partial0") and gives it the target's name on `commit()`.
/// A process that dies, or an error on the way, leaves the target as it was: missing, or the old file. (The file is not
/// forced to the disk: this does not guard against a power cut.) Without `commit()` the destructor removes what was
/// written. Of a symbolic link, the file that it names is written, and made where it is missing.
class AtomicFile {
 public:
  /// @throws Error if no file can be made in the target's folder, or the target is a folder, a device, a pipe or a
  ///         circle of links.
  explicit AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
    std::error_code ignored;
    if (std::filesystem::is_directory(target_, ignored))
      throw Error(target_.string() + ": found a folder, expected a file to write");
    // A rename would replace what is no file, and a link.
    if (std::filesystem::exists(target_, ignored) && !std::filesystem::is_regular_file(target_, ignored))
      throw Error(target_.string() + ": found a device or a pipe, expected a file to write");
    target_ = detail::follow_links(target_);
    detail::NewFile made = detail::make_new_file([this](std::size_t number) {
      std::filesystem::path name = target_;
      return name += ".partial" + std::to_string(number);
    });
    temporary_ = std::move(made.path);
    file_ = made.file;
    if (file_ == nullptr) fail("cannot make " + temporary_.filename().string() + " beside it", made.error);
  }
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile() { discard(); }

  /// Appends bytes as they are.
  /// @throws Error if they can't be written (a full disk may show only at `commit()`), or after `finish()`.
  AtomicFile& write(std::string_view text) {
    require_open();
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail("cannot write", errno);
    return *this;
  }

  /// Writes what is left, so that of several files each is whole before the first gets its name.
  /// @throws Error if it can't be written; nothing is left of it then.
  void finish() {
    require_open();
    errno = 0;
    const bool flushed = std::fflush(file_) == 0;
    const int flush_error = errno;
    const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
    if (!flushed || !closed) {
      const int reason = flushed ? errno : flush_error;
      remove_temporary();
      fail("cannot write", reason);
    }
    is_finished_ = true;
  }

  /// Gives the file its name, over an older one if there is one.
  /// @throws Error if anything is left that can't be written, or the name can't be given; the target is then unchanged.
  void commit() {
    if (!is_finished_) finish();
    is_finished_ = false;
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (!error) return;
    remove_temporary();
    fail("cannot rename " + temporary_.filename().string(), error.value());
  }

 private:
  void require_open() const {
    if (file_ == nullptr) throw Error(target_.string() + ": is finished already, expected no further writing");
  }

  void discard() noexcept {
    if (file_ == nullptr && !is_finished_) return;
    if (file_ != nullptr) std::fclose(std::exchange(file_, nullptr));
    remove_temporary();
  }

  void remove_temporary() noexcept {
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }

  [[noreturn]] void fail(const std::string& what, int error_number) const {
    throw Error(target_.string() + ": " + what + ": " + std::generic_category().message(error_number));
  }

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  std::FILE* file_ = nullptr;
  bool is_finished_ = false;  // whole, and not yet of the target's name
};

}  // namespace stillpoint
