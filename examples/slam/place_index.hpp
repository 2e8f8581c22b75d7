// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which keyframes look like a frame: a binary search tree of descriptors that grows while the camera runs.
// Source: Schlegel and Grisetti, "HBST: A Hamming Distance Embedding Binary Search Tree for Feature-Based Visual Place
// Recognition", RA-L 2018. No vocabulary has to be trained or read.

#include <map>
#include <vector>

#include "descriptor.hpp"
#include "frame.hpp"

namespace examples::slam {

class PlaceIndex {
 public:
  struct Options {
    std::size_t leaf_entries = 64;  ///< more are split in two
    double least_balance = 0.2;     ///< of the smaller half: a bit that parts worse is not worth a level
    int farthest_bits = 40;         ///< of 256 in which two descriptors of one corner may differ
  };
  Options options;

  /// The features of a keyframe that show a point of the map: what the filter dropped is not among them.
  void add(const Keyframe& keyframe);
  void remove(KeyframeId id);

  /// How many features of a frame have one like it in each keyframe, as a share of the lesser number of features.
  std::map<KeyframeId, double> similarity(const Frame& frame) const;

  std::size_t size() const;  ///< entries

 private:
  struct Entry {
    Descriptor descriptor;
    KeyframeId keyframe;
  };
  /// A leaf holds entries; any other node says which bit of a descriptor leads where.
  struct Node {
    int bit = kNone;
    std::size_t child[2] = {0, 0};
    std::vector<Entry> entries;
  };

  static int bit_of(const std::uint8_t* descriptor, int bit) { return descriptor[bit / 8] >> (bit % 8) & 1; }
  std::size_t leaf_of(const std::uint8_t* descriptor) const;
  void split(std::size_t leaf);

  std::vector<Node> nodes_ = std::vector<Node>(1);
  std::map<KeyframeId, int> entries_of_;
};

}  // namespace examples::slam
