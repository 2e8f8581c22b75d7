// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What the files of the module share.

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <string>

#include "stillpoint/policies/with_movers.hpp"
#include "stillpoint/stillpoint.hpp"

namespace stillpoint_python {

namespace py = pybind11;

/// As in "NoneType".
inline std::string type_name(const py::handle& object) { return py::str(py::type::of(object).attr("__name__")); }

/// A filter that threads of Python may share: each call waits for the one before it, and lets other threads run
/// meanwhile.
class Filter {
 public:
  Filter(const stillpoint::Camera& camera, bool has_movers) : filter_(camera) {
    filter_.movers.is_enabled = has_movers;
  }

  /// Calls `use(filter)` without the interpreter's lock: nothing of Python may be touched in it.
  template <class Use>
  decltype(auto) without_gil(Use&& use) {
    const py::gil_scoped_release released;
    const std::lock_guard<std::mutex> lock(mutex_);  // given back before the interpreter's lock is taken again
    return use(filter_);
  }

  /// As `without_gil`, for what visits options: a filter without movers has none of theirs, so that its files are those
  /// of any other.
  template <class Use>
  decltype(auto) with_options(Use&& use) {
    return without_gil([&](stillpoint::FrameFilter<stillpoint::WithMovers<>>& filter) -> decltype(auto) {
      return filter.movers.is_enabled ? use(filter) : use(static_cast<stillpoint::FrameFilter<>&>(filter));
    });
  }

 private:
  std::mutex mutex_;
  stillpoint::FrameFilter<stillpoint::WithMovers<>> filter_;
};

/// The member of an enum of the module, such as Status, for a value of the library.
template <class Enum>
py::object member(const char* name, Enum value) {
  return py::module_::import("stillpoint._core").attr(name)(static_cast<int>(value));
}

void bind_filter(py::module_& module);
void bind_movers(py::module_& module);
void bind_options(py::module_& module);
void bind_evaluation(py::module_& module);

/// `FrameResult.movers`; each of them keeps the result.
py::tuple movers_of(const std::shared_ptr<const stillpoint::FrameResult>& frame);

/// `FrameFilter.options`.
py::object options_of(const std::shared_ptr<Filter>& filter);

}  // namespace stillpoint_python
