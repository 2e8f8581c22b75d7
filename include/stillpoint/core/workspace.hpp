// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Scratch memory of one filter: an arena that is filled during a frame and rewound before the next, so that the
// stages allocate nothing once the largest frame has been seen.

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// Hands out arrays that live until `rewind()` or until the `Scope` in which they were taken ends.
class Workspace {
 public:
  Workspace() = default;
  Workspace(Workspace&&) = default;  // and no copy: those of a filter are refused by name
  Workspace& operator=(Workspace&&) = default;

  /// Rewinds to where it stood when the scope was opened: scratch of a stage ends with the stage.
  class Scope {
   public:
    explicit Scope(Workspace& workspace) noexcept
        : workspace_(workspace), block_(workspace.block_), used_(workspace.used_) {}
    ~Scope() {
      workspace_.block_ = block_;
      workspace_.used_ = used_;
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Workspace& workspace_;
    std::size_t block_, used_;
  };

  /// An array of `count` value-initialised elements, aligned to 64 bytes. O(count); allocates only while the arena
  /// still grows.
  template <class T>
  span<T> take(std::size_t count, const T& value = T{}) {
    static_assert(std::is_trivially_destructible_v<T>, "Workspace::take<T>: T must be trivially destructible.");
    T* const elements = static_cast<T*>(static_cast<void*>(raw(count * sizeof(T))));
    for (std::size_t i = 0; i < count; ++i) new (elements + i) T(value);
    return {elements, count};
  }

  void rewind() noexcept { block_ = used_ = 0; }

 private:
  static constexpr std::size_t kAlignment = 64;
  static constexpr std::size_t kFirstBlockBytes = std::size_t{1} << 16;

  struct AlignedDelete {
    void operator()(std::byte* p) const noexcept { ::operator delete[](p, std::align_val_t{kAlignment}); }
  };
  struct Block {
    std::unique_ptr<std::byte[], AlignedDelete> bytes;
    std::size_t size;
  };

  /// Apart from its callers: inlined into each it would be a twentieth of the whole filter's code.
  [[gnu::noinline]] std::byte* raw(std::size_t bytes) {
    bytes = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    while (block_ < blocks_.size() && used_ + bytes > blocks_[block_].size) {
      ++block_;
      used_ = 0;
    }
    if (block_ == blocks_.size()) {
      std::size_t size = blocks_.empty() ? kFirstBlockBytes : 2 * blocks_.back().size;
      while (size < bytes) size *= 2;
      void* const memory = ::operator new[](size, std::align_val_t{kAlignment});
      blocks_.push_back({std::unique_ptr<std::byte[], AlignedDelete>(static_cast<std::byte*>(memory)), size});
      used_ = 0;
    }
    std::byte* const start = blocks_[block_].bytes.get() + used_;
    used_ += bytes;
    return start;
  }

  std::vector<Block> blocks_;
  std::size_t block_ = 0;
  std::size_t used_ = 0;
};

}  // namespace stillpoint
