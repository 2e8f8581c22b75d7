// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "place_index.hpp"

#include <algorithm>
#include <cstdlib>

namespace examples::slam {

void PlaceIndex::add(const Keyframe& keyframe) {
  for (std::size_t i = 0; i < keyframe.size(); ++i) {
    if (keyframe.point[i] == kNone) continue;
    const std::uint8_t* descriptor = keyframe.descriptor(static_cast<int>(i));
    const std::size_t leaf = leaf_of(descriptor);
    nodes_[leaf].entries.push_back({descriptor_from(descriptor), keyframe.id});
    ++entries_of_[keyframe.id];
    if (nodes_[leaf].entries.size() > options.leaf_entries) split(leaf);
  }
}

void PlaceIndex::remove(KeyframeId id) {
  if (entries_of_.erase(id) == 0) return;
  for (Node& node : nodes_)
    node.entries.erase(
        std::remove_if(node.entries.begin(), node.entries.end(), [id](const Entry& e) { return e.keyframe == id; }),
        node.entries.end());
}

std::map<KeyframeId, double> PlaceIndex::similarity(const Frame& frame) const {
  std::map<KeyframeId, int> found;
  std::vector<KeyframeId> here;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const std::uint8_t* descriptor = frame.descriptor(static_cast<int>(i));
    here.clear();
    for (const Entry& entry : nodes_[leaf_of(descriptor)].entries)
      if (distance_bits(descriptor, entry.descriptor.data()) <= options.farthest_bits) here.push_back(entry.keyframe);
    std::sort(here.begin(), here.end());
    here.erase(std::unique(here.begin(), here.end()), here.end());
    for (const KeyframeId id : here) ++found[id];
  }
  std::map<KeyframeId, double> result;
  for (const auto& [id, count] : found) {
    const auto fewer = std::min(static_cast<double>(frame.size()), static_cast<double>(entries_of_.at(id)));
    result[id] = std::min(1.0, static_cast<double>(count) / fewer);
  }
  return result;
}

std::size_t PlaceIndex::size() const {
  std::size_t sum = 0;
  for (const auto& entry : entries_of_) sum += static_cast<std::size_t>(entry.second);
  return sum;
}

std::size_t PlaceIndex::leaf_of(const std::uint8_t* descriptor) const {
  std::size_t node = 0;
  while (nodes_[node].bit != kNone) node = nodes_[node].child[bit_of(descriptor, nodes_[node].bit)];
  return node;
}

/// By the bit that parts the entries most evenly.
void PlaceIndex::split(std::size_t leaf) {
  const auto count = static_cast<int>(nodes_[leaf].entries.size());
  int best_bit = kNone, best_offset = count;
  for (int bit = 0; bit < kDescriptorBits; ++bit) {
    int ones = 0;
    for (const Entry& entry : nodes_[leaf].entries) ones += bit_of(entry.descriptor.data(), bit);
    const int offset = std::abs(2 * ones - count);
    if (offset >= best_offset) continue;
    best_offset = offset;
    best_bit = bit;
  }
  if (best_bit == kNone || count - best_offset < 2.0 * options.least_balance * count) return;
  const std::size_t first = nodes_.size();
  nodes_.resize(first + 2);
  for (const Entry& entry : nodes_[leaf].entries)
    nodes_[first + static_cast<std::size_t>(bit_of(entry.descriptor.data(), best_bit))].entries.push_back(entry);
  nodes_[leaf].entries = {};
  nodes_[leaf].bit = best_bit;
  nodes_[leaf].child[0] = first;
  nodes_[leaf].child[1] = first + 1;
}

}  // namespace examples::slam
