// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Outputs of a network, of any shape and with any numbers, through the decoder of every layout.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bytes.hpp"
#include "stillpoint/detectors/drop_duplicates.hpp"
#include "stillpoint/detectors/network_decoder.hpp"

namespace {

using namespace stillpoint;

struct Output {
  TensorShape shape;
  std::vector<float> values;
  bool whole_numbers;
};

/// A few thousand numbers at most, so that a run is short. The bytes fill the first; the rest repeats them.
Output make_output(fuzz::Bytes& bytes) {
  constexpr std::size_t kMostElements = 20000;
  std::vector<int> extents;
  std::size_t count = 1;
  const int rank = bytes.integer(0, TensorShape::kHighestRank);
  for (int d = 0; d < rank; ++d) {
    int extent = bytes.integer(0, 255);
    if (extent == 255) extent = bytes.integer(-2, 9000);
    if (extent > 0 && count * static_cast<std::size_t>(extent) > kMostElements) extent = 1;
    count *= extent > 0 ? static_cast<std::size_t>(extent) : 1;
    extents.push_back(extent);
  }
  Output output{TensorShape(extents), {}, bytes.flag()};
  output.values.resize(output.shape.count());
  std::vector<float> pattern(static_cast<std::size_t>(bytes.integer(1, 48)));
  const double most = bytes.flag() ? 1.0 : 100.0;
  for (float& value : pattern) value = bytes.single(-0.2 * most, most);
  for (std::size_t i = 0; i < output.values.size(); ++i) output.values[i] = pattern[i % pattern.size()];
  if (output.whole_numbers)  // they were integers
    for (float& value : output.values) value = std::isfinite(value) ? std::round(value) : value;
  return output;
}

void run(fuzz::Bytes& bytes) {
  DetectorOptions options;
  options.layout = static_cast<DetectorLayout>(
      bytes.integer(static_cast<int>(DetectorLayout::automatic), static_cast<int>(DetectorLayout::label_map)));
  std::vector<std::string> names;
  for (int i = bytes.integer(0, 90); i > 0; --i) names.push_back(i % 7 == 0 ? "" : i % 2 == 0 ? "person" : "chair");
  options.classes = ClassList(names);
  options.lowest_confidence = bytes.single(0, 1);
  if (bytes.flag()) options.first_class_number = bytes.integer(-2, 3);
  if (bytes.flag()) options.coding = YoloCoding{bytes.flag(), {1.1f}, {{10, 13}, {16, 30}}};
  const InputSize input{bytes.integer(0, 255), bytes.integer(0, 255)};
  std::vector<Output> outputs;
  for (int i = bytes.integer(0, 9); i > 0; --i) outputs.push_back(make_output(bytes));
  std::vector<Tensor> tensors;
  for (const Output& output : outputs) tensors.push_back({output.shape, output.values.data(), output.whole_numbers});

  const NetworkDecoder decoder(options, input, tensors);
  const Letterbox letterbox({bytes.integer(0, 300), bytes.integer(0, 300)}, input,
                            static_cast<ImageFit>(bytes.integer(0, 2)));
  std::vector<RawDetection> raw;
  std::vector<Detection> found;
  decoder.decode(tensors, raw);
  if (raw.size() < 500) drop_duplicates(raw, 0.45f);
  decoder.finish(tensors, letterbox, raw, found);
  for (const Detection& detection : found) {
    const Box& box = detection.box;
    fuzz::require(std::isfinite(box.x) && std::isfinite(box.y) && box.width > 0 && box.height > 0);
    fuzz::require(detection.class_index >= 0 &&
                  static_cast<std::size_t>(detection.class_index) < decoder.classes().size());
    detection.holds({box.x + 0.3f * box.width, box.y + 0.7f * box.height}, 1.0);
    detection.holds({box.x + box.width, box.y + box.height}, 0.0);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  try {
    run(bytes);
  } catch (const stillpoint::Error&) {
  }
  return 0;
}
