// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The names behind a network's class numbers: lists that come with the library, or a file of the user's.

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/regular_file.hpp"

namespace stillpoint {

/// Names in the order of their numbers. An empty name, or "background" as the first, is no class.
class ClassList {
 public:
  ClassList() = default;
  explicit ClassList(std::vector<std::string> names) : names_(std::move(names)) {}

  std::size_t size() const noexcept { return names_.size(); }
  bool empty() const noexcept { return names_.empty(); }
  const std::string& operator[](std::size_t index) const { return names_[index]; }

  /// Does number 0 mean "nothing", as in most lists for segmentation?
  bool starts_with_background() const noexcept {
    if (names_.empty()) return false;
    const std::string& first = names_.front();
    return first.empty() || first == "background" || first == "__background__" || first == "unlabeled" ||
           first == "N/A";
  }

  /// Is this the number of a class, not of the background, a gap, or nothing in the list?
  bool names(int index) const noexcept {
    return index >= 0 && static_cast<std::size_t>(index) < size() && !names_[static_cast<std::size_t>(index)].empty() &&
           !(index == 0 && starts_with_background());
  }

  /// The 80 classes of COCO (Lin et al., "Microsoft COCO", 2014) without gaps: person is 0.
  static ClassList coco() {
    std::vector<std::string> names;
    const ClassList with_gaps = coco91();
    for (std::size_t i = 1; i < with_gaps.size(); ++i)
      if (!with_gaps[i].empty()) names.push_back(with_gaps[i]);
    return ClassList(std::move(names));
  }

  /// COCO's own numbers, 0 to 90: person is 1, eleven numbers stand for nothing. For DETR, torchvision and TensorFlow.
  static ClassList coco91() {
    return between_commas(
        "background,person,bicycle,car,motorcycle,airplane,bus,train,truck,boat,traffic light,fire hydrant,,"
        "stop sign,parking meter,bench,bird,cat,dog,horse,sheep,cow,elephant,bear,zebra,giraffe,,backpack,"
        "umbrella,,,handbag,tie,suitcase,frisbee,skis,snowboard,sports ball,kite,baseball bat,baseball glove,"
        "skateboard,surfboard,tennis racket,bottle,,wine glass,cup,fork,knife,spoon,bowl,banana,apple,"
        "sandwich,orange,broccoli,carrot,hot dog,pizza,donut,cake,chair,couch,potted plant,bed,,dining table,"
        ",,toilet,,tv,laptop,mouse,remote,keyboard,cell phone,microwave,oven,toaster,sink,refrigerator,,book,"
        "clock,vase,scissors,teddy bear,hair drier,toothbrush");
  }

  /// Pascal VOC (Everingham et al., 2010), 21 with the background at 0: person is 15.
  static ClassList voc21() {
    std::vector<std::string> names = voc().names_;
    names.insert(names.begin(), "background");
    return ClassList(std::move(names));
  }
  /// The same 20 without the background: person is 14.
  static ClassList voc() {
    return between_commas(
        "aeroplane,bicycle,bird,boat,bottle,bus,car,cat,chair,cow,diningtable,dog,horse,motorbike,person,"
        "pottedplant,sheep,sofa,train,tvmonitor");
  }

  /// The 19 classes of Cityscapes (Cordts et al., 2016) that are evaluated: person is 11.
  static ClassList cityscapes() {
    return between_commas(
        "road,sidewalk,building,wall,fence,pole,traffic light,traffic sign,vegetation,terrain,sky,person,"
        "rider,car,truck,bus,train,motorcycle,bicycle");
  }

  static ClassList person() { return ClassList({"person"}); }

  /// One of the lists above by its name ("coco", "coco91", "voc", "voc21", "cityscapes", "person"), else a file.
  /// @throws Error as `read` does.
  static ClassList named(const std::string& name_or_file) {
    for (const auto& [name, list] :
         {std::pair{"coco", &coco}, std::pair{"coco91", &coco91}, std::pair{"voc", &voc}, std::pair{"voc21", &voc21},
          std::pair{"cityscapes", &cityscapes}, std::pair{"person", &person}})
      if (name_or_file == name) return list();
    return read(name_or_file);
  }

  /// A file with one name a line, the first for number 0. A line "???" or "N/A" is a gap; blank lines at the end do
  /// not count.
  /// @throws Error naming file and line if it can't be read, has no name, or a blank line between names.
  static ClassList read(const std::filesystem::path& file) {
    detail::require_regular_file(file, "a file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw Error(file.string() + ": cannot be read");
    std::vector<std::string> names;
    std::size_t line = 0, blank_line = 0;
    for (std::string text; std::getline(stream, text);) {
      if (++line == 1 && text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);  // some editors' byte order mark
      text = trimmed(text);
      if (text.find('\0') != text.npos || text.size() > kLongestName)
        throw Error(at(file, line) + ": found something else than a class name, expected one name a line");
      if (text.empty()) {
        if (blank_line == 0) blank_line = line;
        continue;
      }
      if (blank_line != 0)
        throw Error(at(file, blank_line) + ": found a blank line, expected a class name (??? where a number has none)");
      names.push_back(text == "???" || text == "N/A" ? "" : text);
    }
    if (stream.bad()) throw Error(file.string() + ": cannot be read");
    if (names.empty()) throw Error(file.string() + ": found no name, expected one class name a line");
    if (names.size() > static_cast<std::size_t>(std::numeric_limits<short>::max()))
      throw Error(file.string() + ": found " + std::to_string(names.size()) + " names, expected fewer than 32768");
    return ClassList(std::move(names));
  }

 private:
  static constexpr std::size_t kLongestName = 200;

  static ClassList between_commas(std::string_view text) {
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      names.emplace_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
    return ClassList(std::move(names));
  }
  static std::string at(const std::filesystem::path& file, std::size_t line) {
    return file.string() + ":" + std::to_string(line);
  }
  static std::string trimmed(const std::string& text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    return begin == text.npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
  }

  std::vector<std::string> names_;
};

}  // namespace stillpoint
