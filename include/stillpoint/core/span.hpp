// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A view of contiguous elements, as C++20's std::span with a dynamic extent, for C++17.

#include <cstddef>
#include <type_traits>
#include <utility>

#include "stillpoint/core/no_fast_math.hpp"

namespace stillpoint {

/// Non-owning view of `size()` contiguous elements. Copying copies the view, not the elements.
template <class T>
class span {
 public:
  using element_type = T;
  using value_type = std::remove_cv_t<T>;

  constexpr span() noexcept = default;
  constexpr span(T* data, std::size_t size) noexcept : data_(data), size_(size) {}

  template <class U, std::size_t kSize, class = std::enable_if_t<std::is_convertible_v<U (*)[], T (*)[]>>>
  constexpr span(U (&array)[kSize]) noexcept : data_(array), size_(kSize) {}

  /// From anything contiguous: std::vector, std::array, another span.
  template <class Range, class = std::enable_if_t<std::is_convertible_v<
                             std::remove_pointer_t<decltype(std::declval<Range&>().data())> (*)[], T (*)[]>>>
  constexpr span(Range&& range) noexcept : data_(range.data()), size_(range.size()) {}

  constexpr T* data() const noexcept { return data_; }
  constexpr std::size_t size() const noexcept { return size_; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  constexpr T& operator[](std::size_t i) const noexcept { return data_[i]; }
  constexpr T* begin() const noexcept { return data_; }
  constexpr T* end() const noexcept { return data_ + size_; }
  constexpr T& front() const noexcept { return data_[0]; }
  constexpr T& back() const noexcept { return data_[size_ - 1]; }
  constexpr span first(std::size_t count) const noexcept { return {data_, count}; }
  constexpr span subspan(std::size_t offset, std::size_t count) const noexcept { return {data_ + offset, count}; }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

template <class T, std::size_t kSize>
span(T (&)[kSize]) -> span<T>;

template <class Range>
span(Range&) -> span<std::remove_pointer_t<decltype(std::declval<Range&>().data())>>;

}  // namespace stillpoint
