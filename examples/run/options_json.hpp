// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The options of a filter's stages as JSON, for report.json.

#include <nlohmann/json.hpp>

#include "stillpoint/core/options.hpp"
#include "stillpoint/filter_frame.hpp"

namespace stillpoint_run {

/// A map of the options that are visited, groups as maps of their own.
class OptionsJson : public stillpoint::LooksAtOptions<OptionsJson> {
 public:
  template <class T>
  void number(const char* name, T& value) {
    map[name] = value;
  }
  template <class T>
  void group(const char* name, T& value) {
    OptionsJson nested;
    each_option(value, nested);
    map[name] = nested.map;
  }
  void word(const char* name, const char* text) { map[name] = text; }

  nlohmann::ordered_json map = nlohmann::ordered_json::object();
};

template <class Policies>
nlohmann::ordered_json options_json(stillpoint::FrameFilter<Policies>& filter) {
  OptionsJson json;
  each_option(filter, json);
  return json.map;
}

}  // namespace stillpoint_run
