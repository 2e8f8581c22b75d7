// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Replaces the program's operator new and counts what it is asked for: include it in one file of a program only.

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace stillpoint::counted_allocations {

inline std::atomic<bool> counting{false};
inline std::atomic<std::size_t> allocations{0};

/// How often `work` allocates.
template <class Work>
std::size_t count_in(Work&& work) {
  const std::size_t before = allocations;
  counting = true;
  work();
  counting = false;
  return allocations - before;
}

inline void* take(std::size_t size, std::size_t alignment) noexcept {
  if (counting) ++allocations;
  const std::size_t padded = (size + alignment - 1) / alignment * alignment;
  return std::aligned_alloc(alignment, padded == 0 ? alignment : padded);
}

inline void* take_or_throw(std::size_t size, std::size_t alignment) {
  if (void* const memory = take(size, alignment)) return memory;
  throw std::bad_alloc();
}

/// Not inlined: g++ would see new paired with free, and warn.
[[gnu::noinline]] inline void release(void* memory) noexcept { std::free(memory); }

inline constexpr std::size_t kUsualAlignment = alignof(std::max_align_t);

}  // namespace stillpoint::counted_allocations

// Each form, those of std::nothrow too (std::stable_sort uses it): a sanitizer has its own for what is missing here,
// and refuses to see the two mixed.
void* operator new(std::size_t size) {
  using namespace stillpoint::counted_allocations;
  return take_or_throw(size, kUsualAlignment);
}
void* operator new[](std::size_t size) {
  using namespace stillpoint::counted_allocations;
  return take_or_throw(size, kUsualAlignment);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  using namespace stillpoint::counted_allocations;
  return take(size, kUsualAlignment);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  using namespace stillpoint::counted_allocations;
  return take(size, kUsualAlignment);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return stillpoint::counted_allocations::take_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return stillpoint::counted_allocations::take_or_throw(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { stillpoint::counted_allocations::release(memory); }
void operator delete[](void* memory) noexcept { stillpoint::counted_allocations::release(memory); }
void operator delete(void* memory, std::size_t) noexcept { stillpoint::counted_allocations::release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { stillpoint::counted_allocations::release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { stillpoint::counted_allocations::release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept {
  stillpoint::counted_allocations::release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept { stillpoint::counted_allocations::release(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { stillpoint::counted_allocations::release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  stillpoint::counted_allocations::release(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  stillpoint::counted_allocations::release(memory);
}
