// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How many frames of all inputs were judged: inputs of which none is say nothing of the stages. run.sh reads the line.

#include <cstddef>
#include <cstdio>

namespace fuzz {

class JudgedFrames {
 public:
  explicit JudgedFrames(const char* by) noexcept : by_(by) {}
  ~JudgedFrames() { std::fprintf(stderr, "judged: %zu of %zu frames by %s\n", judged_, frames_, by_); }
  JudgedFrames(const JudgedFrames&) = delete;
  JudgedFrames& operator=(const JudgedFrames&) = delete;

  void count(bool is_judged) noexcept {
    ++frames_;
    judged_ += is_judged ? 1 : 0;
  }

 private:
  const char* by_;
  std::size_t frames_ = 0, judged_ = 0;
};

}  // namespace fuzz
