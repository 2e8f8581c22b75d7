// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// stillpoint_accuracy [DATA [FRAMES]]: what each choice of the paper costs, and what each correction is worth, as
// tables in Markdown on standard output. DATA holds kitchen_walk, kitchen_box and kitchen_static; what is not there is
// left out. FRAMES, if given, is the number of frames that is taken of each sequence.

#include <opencv2/core/utility.hpp>

#include <charconv>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "accuracy_methods.hpp"
#include "accuracy_sequence.hpp"
#include "parallel.hpp"
#include "stillpoint/core/error.hpp"

namespace stillpoint::bench {
namespace {

/// What a table has a column for.
struct Trial {
  std::string name;
  std::function<LabelledSequence()> load;
  bool gives_boxes;
};

std::vector<Trial> trials(const std::filesystem::path& data, std::size_t most_frames) {
  const auto synthetic = [most_frames](auto scene) {
    return [scene, most_frames] { return rendered_sequence(scene(), most_frames); };
  };
  std::vector<Trial> result = {
      {"walking_people, boxes", synthetic([] { return synthetic::walking_people(); }), true},
      {"walking_people", synthetic([] { return synthetic::walking_people(); }), false},
      {"pushed_box", synthetic([] { return synthetic::pushed_box(); }), false},
      {"slow_mover", synthetic([] { return slow_mover(); }), false},
      {"static_room", synthetic([] { return synthetic::static_room(); }), false},
  };
  const auto recorded = [&](const char* name, const char* column, bool gives_boxes) {
    const std::filesystem::path folder = data / name;
    if (std::filesystem::exists(folder / "camera.yaml"))
      result.push_back({column, [folder, most_frames] { return recorded_sequence(folder, most_frames); }, gives_boxes});
    else
      std::fprintf(stderr, "stillpoint_accuracy: no %s: left out\n", folder.string().c_str());
  };
  recorded("kitchen_walk", "kitchen_walk, boxes", true);
  recorded("kitchen_walk", "kitchen_walk", false);
  recorded("kitchen_box", "kitchen_box", false);
  recorded("kitchen_static", "kitchen_static", false);
  return result;
}

std::string cell(const std::optional<double>& value, const char* format) {
  if (!value) return "n/a";
  char text[32];
  std::snprintf(text, sizeof text, format, *value);
  return text;
}

void print_table(const char* title, const std::vector<Trial>& columns, const std::vector<Method>& rows,
                 const std::vector<std::vector<Outcome>>& outcomes,
                 const std::function<std::string(const Outcome&)>& text) {
  std::printf("**%s**\n\n| |", title);
  for (const Trial& column : columns) std::printf(" %s |", column.name.c_str());
  std::printf("\n|---|");
  for (std::size_t c = 0; c < columns.size(); ++c) std::printf("---|");
  std::printf("\n");
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::printf("| %s |", rows[r].name.c_str());
    for (std::size_t c = 0; c < columns.size(); ++c) std::printf(" %s |", text(outcomes[c][r]).c_str());
    std::printf("\n");
  }
  std::printf("\n");
}

void measure(const std::filesystem::path& data, std::size_t most_frames, unsigned thread_count) {
  const std::vector<Trial> columns = trials(data, most_frames);
  const std::vector<Method> rows = methods();
  std::vector<std::vector<Outcome>> outcomes(columns.size());
  // A column is one thread's: filters know nothing of each other, so that the numbers do not depend on the threads.
  for_each_in_parallel(columns.size(), thread_count, [&](std::size_t c) {
    const LabelledSequence sequence = columns[c].load();
    for (const Method& row : rows) outcomes[c].push_back(row.run(sequence, columns[c].gives_boxes));
    std::fprintf(stderr, "stillpoint_accuracy: %s done\n", columns[c].name.c_str());
  });

  if (most_frames != kAllFrames) std::printf("At most %zu frames of each sequence.\n\n", most_frames);
  print_table("Recall on dynamic features / false positives on the background, %", columns, rows, outcomes,
              [](const Outcome& o) {
                return cell(o.recall_percent, "%.1f") + " / " + cell(o.false_positives_percent, "%.1f");
              });
  print_table("Error of the motion from frame to frame, 95th percentile: mm / degrees", columns, rows, outcomes,
              [](const Outcome& o) { return cell(o.p95_mm, "%.1f") + " / " + cell(o.p95_deg, "%.2f"); });
}

}  // namespace
}  // namespace stillpoint::bench

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  try {
    constexpr unsigned kThreads = 2;
    std::size_t most_frames = stillpoint::bench::kAllFrames;
    if (argc > 2) {
      const std::string_view text = argv[2];
      const auto result = std::from_chars(text.data(), text.data() + text.size(), most_frames);
      if (result.ec != std::errc() || result.ptr != text.data() + text.size() || most_frames < 2)
        throw stillpoint::Error("FRAMES: found '" + std::string(text) + "', expected a whole number from 2");
    }
    stillpoint::bench::measure(argc > 1 ? argv[1] : STILLPOINT_SHARED_DATA, most_frames, kThreads);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stillpoint_accuracy: %s\n", error.what());
    return 2;
  }
  return 0;
}
