// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// FrameFilter.options: every option of the one table (core/options.hpp) as an attribute, under its name in
// docs/tuning.md.

#include <pybind11/stl.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "bindings.hpp"
#include "stillpoint/cluster/surface_clusters.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/match/patch_matcher.hpp"
#include "stillpoint/memory/evidence_memory.hpp"
#include "stillpoint/motion/rigid/support_motion.hpp"
#include "stillpoint/movers/mover_tracking.hpp"
#include "stillpoint/options/options_file.hpp"
#include "stillpoint/prior/propagated_prior.hpp"
#include "stillpoint/score/reprojection_score.hpp"

namespace stillpoint_python {
namespace {

using stillpoint::OptionRange;
/// Signed and unsigned whole numbers are apart: a seed takes all of the latter.
using Value = std::variant<bool, std::int64_t, std::uint64_t, double, std::string>;
using Table = std::vector<std::pair<std::string, Value>>;  // of full names, as in "matcher.corners.cell_px"

/// Lists all options.
class ListOptions : public stillpoint::LooksAtOptions<ListOptions> {
 public:
  explicit ListOptions(Table& table, std::string path = "") : table_(table), path_(std::move(path)) {}

  template <class T>
  void number(const char* name, T& value) {
    if constexpr (std::is_same_v<T, bool>)
      table_.emplace_back(path_ + name, value);
    else if constexpr (std::is_integral_v<T>)
      table_.emplace_back(path_ + name,
                          static_cast<std::conditional_t<std::is_signed_v<T>, std::int64_t, std::uint64_t>>(value));
    else  // 0.3 of a float is 0.3, not 0.30000001192092896
      table_.emplace_back(path_ + name, *stillpoint::parse_number(stillpoint::option_text(value)));
  }
  void word(const char* name, const char* text) { table_.emplace_back(path_ + name, std::string(text)); }
  template <class T>
  void group(const char* name, T& value) {
    ListOptions nested(table_, path_ + name + '.');
    each_option(value, nested);
  }

 private:
  Table& table_;
  std::string path_;
};

/// Sets one option, or throws an Error in the words of `OptionCheck` and changes nothing.
class SetOption {
 public:
  SetOption(std::string name, const Value& value) : full_name_(std::move(name)), value_(value), rest_(full_name_) {}

  template <class T>
  void operator()(const char* name, T& option, const OptionRange& range) {
    if (name == rest_) option = number<T>(range, stillpoint::expected_of<T>(range));
  }
  template <class T>
  void seed(const char* name, T& option) {
    constexpr T kMost = std::numeric_limits<T>::max();
    if (name == rest_)
      option = number<T>({0, static_cast<double>(kMost)}, "a whole number from 0 to " + std::to_string(kMost));
  }
  template <class T>
  void operator()(const char* name, T& option) {
    if constexpr (std::is_same_v<T, bool>) {
      if (name != rest_) return;
      if (!std::holds_alternative<bool>(value_)) fail("True or False");
      option = std::get<bool>(value_);
    } else if constexpr (stillpoint::has_options<T, SetOption>::value) {
      const std::string prefix = std::string(name) + '.';
      if (rest_.compare(0, prefix.size(), prefix) != 0) return;
      rest_.erase(0, prefix.size());
      each_option(option, *this);
      rest_.clear();
    }
  }
  template <class T, class... Words>
  void choice(const char* name, T& option, Words... words) {
    if (name != rest_) return;
    std::size_t index = 0;
    for (const char* const word : {words...}) {
      if (value_ == Value(std::string(word))) {
        option = static_cast<T>(index);
        return;
      }
      ++index;
    }
    fail(stillpoint::expected_of_choice(words...));
  }

 private:
  template <class T>
  T number(const OptionRange& range, const std::string& expected) const {
    return std::visit(
        [&](const auto& value) -> T {
          using V = std::decay_t<decltype(value)>;
          if constexpr (std::is_arithmetic_v<V> && !std::is_same_v<V, bool> &&
                        (std::is_floating_point_v<T> || std::is_integral_v<V>)) {
            const auto converted = static_cast<T>(value);
            const bool fits = std::is_floating_point_v<T> ||
                              (static_cast<V>(converted) == value && (value < V{0}) == (converted < T{0}));
            if (fits && range.contains(static_cast<double>(converted))) return converted;
          }
          fail(expected);
        },
        value_);
  }

  [[noreturn]] void fail(const std::string& expected) const {
    const std::string found = std::visit(
        [](const auto& value) -> std::string {
          using V = std::decay_t<decltype(value)>;
          if constexpr (std::is_same_v<V, std::string>)
            return '\'' + value + '\'';
          else if constexpr (std::is_same_v<V, bool>)
            return value ? "True" : "False";
          else
            return stillpoint::option_text(value);
        },
        value_);
    throw stillpoint::Error(full_name_ + " is " + found + ", expected " + expected);
  }

  std::string full_name_;
  const Value& value_;
  std::string rest_;  // of the name, below the groups that are entered
};

/// The value that Python hands over; a number of NumPy is one, too.
Value value_of(const std::string& name, const py::handle& object) {
  if (PyBool_Check(object.ptr())) return object.ptr() == Py_True;
  if (py::isinstance<py::str>(object)) return std::string(py::str(object));
  if (PyIndex_Check(object.ptr())) {
    const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr()));
    if (!whole) throw py::error_already_set();
    int overflow = 0;
    const long long value = PyLong_AsLongLongAndOverflow(whole.ptr(), &overflow);
    if (overflow == 0) return static_cast<std::int64_t>(value);
    if (overflow > 0) {
      const unsigned long long large = PyLong_AsUnsignedLongLong(whole.ptr());
      if (PyErr_Occurred() == nullptr) return static_cast<std::uint64_t>(large);
      PyErr_Clear();
    }
    const double large = PyLong_AsDouble(whole.ptr());
    if (PyErr_Occurred() == nullptr) return large;
    PyErr_Clear();  // beyond a double
    return overflow > 0 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  }
  const double value = PyFloat_AsDouble(object.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw py::type_error(name + " is " + type_name(object) + ", expected a number, a word or a bool");
  }
  return value;
}

py::object object_of(const Value& value) {
  return std::visit([](const auto& held) -> py::object { return py::cast(held); }, value);
}

/// The options, or those of one stage or group.
class Options {
 public:
  Options(std::shared_ptr<Filter> filter, std::string path) : filter_(std::move(filter)), path_(std::move(path)) {}

  py::object get(const std::string& name) const {
    for (const auto& [option, value] : table()) {
      if (option == path_ + name) return object_of(value);
      if (option.compare(0, path_.size() + name.size() + 1, path_ + name + '.') == 0)
        return py::cast(Options(filter_, path_ + name + '.'));
    }
    throw py::attribute_error(unknown(name));
  }

  void set(const std::string& name, const py::object& object) const {
    for (const auto& entry : table()) {
      if (entry.first != path_ + name) continue;
      const Value value = value_of(path_ + name, object);
      return filter_->with_options([&](auto& filter) {
        SetOption setter(path_ + name, value);
        each_option(filter, setter);
      });
    }
    throw py::attribute_error(unknown(name));
  }

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : table()) {
      if (entry.first.compare(0, path_.size(), path_) != 0) continue;
      const std::string rest = entry.first.substr(path_.size());
      const std::string name = rest.substr(0, rest.find('.'));
      if (names.empty() || names.back() != name) names.push_back(name);
    }
    return names;
  }

  py::dict flat() const {
    py::dict values;
    for (const auto& [option, value] : table())
      if (option.compare(0, path_.size(), path_) == 0) values[option.c_str()] = object_of(value);
    return values;
  }

  std::string representation() const {
    std::string text;
    for (const auto& item : flat())
      text += std::string(py::str(item.first)) + " = " + std::string(py::repr(item.second)) + '\n';
    return text;
  }

 private:
  Table table() const {
    return filter_->with_options([](auto& filter) {
      Table table;
      ListOptions lister(table);
      each_option(filter, lister);
      return table;
    });
  }

  std::string unknown(const std::string& name) const {
    std::string list;
    for (const std::string& known : names()) list += (list.empty() ? "" : ", ") + known;
    return path_ + name + " is unknown, expected one of " + list;
  }

  std::shared_ptr<Filter> filter_;
  std::string path_;  // of the group, with a point behind it; empty for all options
};

}  // namespace

py::object options_of(const std::shared_ptr<Filter>& filter) { return py::cast(Options(filter, "")); }

void bind_options(py::module_& module) {
  py::class_<Options>(
      module, "Options",
      "The options of a filter's stages, by the names in docs/tuning.md:\n"
      "filter.options.gate.false_positive_rate = 0.005. A value out of its range is an Error, and changes\n"
      "nothing.")
      .def("__getattr__", &Options::get)
      .def("__setattr__", &Options::set)
      .def("__dir__", &Options::names)
      .def("as_dict", &Options::flat, "All of them by their full names, in the order of the table.")
      .def("__repr__", &Options::representation);
}

}  // namespace stillpoint_python
