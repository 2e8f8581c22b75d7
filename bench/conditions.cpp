// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// stillpoint_conditions [FOLDER...]: the filter, and the odometry of examples/ behind it, over labelled recordings
// under each condition of degradations.hpp; one table in Markdown on standard output. conditions.sh builds and runs it.

#include <opencv2/core/utility.hpp>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "conditions.hpp"
#include "parallel.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/evaluation/error_statistics.hpp"
#include "stillpoint/options/options_file.hpp"
#include "stillpoint/policies/with_movers.hpp"

namespace stillpoint::bench {
namespace {

struct Arguments {
  std::vector<std::filesystem::path> folders;
  std::vector<std::string> only;
  std::size_t seeds = 3;
  std::size_t frames = kAllFrames;
  std::string options_file;
  bool without_trackers = false;
  bool with_boxes = false;
  bool with_movers = false;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
};

/// A row of the table, filled run by run.
struct Row {
  std::filesystem::path folder;
  Condition condition;
  std::vector<ConditionOutcome> outcomes;                 ///< one a run
  std::vector<std::optional<double>> labels, unfiltered;  ///< ATE in metres, one a run
};

/// Runs differ by the seed of the condition and of the filter's own random numbers, and by where they begin.
FrameFilter<WithMovers<>> make_filter(const LabelledSequence& sequence, const Arguments& arguments, std::size_t run) {
  FrameFilter<WithMovers<>> filter(sequence.camera);
  filter.movers.is_enabled = arguments.with_movers;
  if (!arguments.options_file.empty()) read_options(arguments.options_file, filter);
  filter.ego_motion.options.seed += run;
  return filter;
}

void run_once(Row& row, std::size_t run, const Arguments& arguments) {
  LabelledSequence sequence = degraded_sequence(row.folder, row.condition, run, arguments.frames);
  if (arguments.with_boxes)
    add_boxes(row.folder, sequence.camera.width() / static_cast<double>(TumSequence(row.folder).camera().width()),
              sequence);
  row.outcomes[run] = run_filter(sequence, make_filter(sequence, arguments, run), !arguments.without_trackers);
  if (arguments.without_trackers) return;
  const auto nothing = [](const auto&, const auto&, const auto&) {};
  row.unfiltered[run] = ate_rmse_m(sequence, run_odometry(sequence, NullFilter{}, nothing));
  const bool has_labels = !sequence.frames.empty() && !sequence.frames.front().labels.empty();
  if (has_labels && row.outcomes[run].filter.recall_percent)
    row.labels[run] = ate_rmse_m(sequence, run_odometry(sequence, examples::OracleFilter{}, nothing));
}

/// Over the runs of a condition.
struct Summary {
  double mean = 0, median = 0, least = 0, most = 0;
};

template <class Values, class Read>
std::optional<Summary> summary(const Values& values, Read&& read) {
  std::vector<double> known;
  for (const auto& value : values)
    if (const std::optional<double> number = read(value)) known.push_back(*number);
  if (known.empty()) return std::nullopt;
  const ErrorStatistics statistics = error_statistics(known);
  return Summary{statistics.mean, statistics.median, statistics.min, statistics.max};
}

/// @param figure  what stands before the brackets
std::string cell(const std::optional<Summary>& runs, double Summary::*figure, int digits, double scale = 1.0) {
  if (!runs) return "n/a";
  char text[96];
  std::snprintf(text, sizeof text, "%.*f (%.*f to %.*f)", digits, scale * ((*runs).*figure), digits,
                scale * runs->least, digits, scale * runs->most);
  return text;
}

void print_head() {
  std::printf(
      "| recording | condition | runs | recall | false-positive rate | own motion p95, mm | own motion p95, deg | "
      "ATE filtered, m | ATE labels, m | ATE unfiltered, m |\n|---|---|---|---|---|---|---|---|---|---|\n");
}

void print(const Row& row) {
  const auto number = [](const std::optional<double>& value) { return value; };
  const auto of_filter = [&](std::optional<double> Outcome::*figure) {
    return summary(row.outcomes, [figure](const ConditionOutcome& outcome) { return outcome.filter.*figure; });
  };
  const auto filtered = summary(row.outcomes, [](const ConditionOutcome& outcome) { return outcome.ate_filtered_m; });
  std::printf("| %s | %s | %zu | %s | %s | %s | %s | %s | %s | %s |\n", row.folder.filename().string().c_str(),
              row.condition.name.c_str(), row.outcomes.size(),
              cell(of_filter(&Outcome::recall_percent), &Summary::mean, 3, 0.01).c_str(),
              cell(of_filter(&Outcome::false_positives_percent), &Summary::mean, 4, 0.01).c_str(),
              cell(of_filter(&Outcome::p95_mm), &Summary::mean, 1).c_str(),
              cell(of_filter(&Outcome::p95_deg), &Summary::mean, 2).c_str(),
              cell(filtered, &Summary::median, 4).c_str(),
              cell(summary(row.labels, number), &Summary::median, 4).c_str(),
              cell(summary(row.unfiltered, number), &Summary::median, 4).c_str());
  std::fflush(stdout);
}

/// Prints each row as soon as it and those before it are measured: an error, or Ctrl-C, loses nothing that is known.
class RowPrinter {
 public:
  explicit RowPrinter(const std::vector<Row>& rows) : rows_(rows) {
    for (const Row& row : rows) missing_.push_back(row.outcomes.size());
  }

  void run_ended(std::size_t row) {
    const std::lock_guard<std::mutex> lock(guard_);
    --missing_[row];
    for (; printed_ < rows_.size() && missing_[printed_] == 0; ++printed_) print(rows_[printed_]);
  }

 private:
  const std::vector<Row>& rows_;
  std::vector<std::size_t> missing_;  // runs, by row
  std::size_t printed_ = 0;
  std::mutex guard_;
};

/// Ends the line of progress before what follows it, an error's message, too.
struct ProgressLine {
  ProgressLine() noexcept {}
  ~ProgressLine() { std::fputc('\n', stderr); }
};

void measure(const Arguments& arguments) {
  for (const std::filesystem::path& folder : arguments.folders)
    TumSequence{folder};  // a wrong one, before an hour's work
  std::vector<Row> rows;
  for (const std::filesystem::path& folder : arguments.folders)
    for (const Condition& condition : conditions()) {
      const bool is_wanted = arguments.only.empty() || std::find(arguments.only.begin(), arguments.only.end(),
                                                                 condition.name) != arguments.only.end();
      if (!is_wanted) continue;
      Row row{folder, condition, {}, {}, {}};
      row.outcomes.resize(condition.runs(arguments.seeds));
      row.labels.resize(row.outcomes.size());
      row.unfiltered.resize(row.outcomes.size());
      rows.push_back(std::move(row));
    }
  std::vector<std::pair<std::size_t, std::size_t>> jobs;
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t run = 0; run < rows[r].outcomes.size(); ++run) jobs.emplace_back(r, run);
  std::atomic<std::size_t> done{0};
  print_head();
  RowPrinter printer(rows);
  const ProgressLine line;
  for_each_in_parallel(jobs.size(), arguments.threads, [&](std::size_t j) {
    run_once(rows[jobs[j].first], jobs[j].second, arguments);
    std::fprintf(stderr, "\r%zu of %zu runs\r", ++done, jobs.size());
    printer.run_ended(jobs[j].first);
  });
}

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Runs the filter over labelled recordings under many conditions.", "stillpoint_conditions");
  std::vector<std::string> folders, names;
  for (const Condition& condition : conditions()) names.push_back(condition.name);
  app.add_option("folder", folders,
                 "folders in the layout of the TUM benchmark with labels/ [kitchen_* of the shared data]");
  app.add_option("--only", arguments.only, "conditions, separated by commas [all]")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_option("--seeds", arguments.seeds, "runs of each condition and phase, each from a later frame [3]")
      ->check(CLI::Range(1, 100));
  app.add_option("--frames", arguments.frames, "of each recording [all]")->check(CLI::Range(2, 1000000));
  app.add_option("--options", arguments.options_file, "options of the stages, YAML")->check(CLI::ExistingFile);
  app.add_option("--threads", arguments.threads, "[one a core]")->check(CLI::Range(1, 256));
  app.add_flag("--without-trackers", arguments.without_trackers, "the filter alone");
  app.add_flag("--boxes", arguments.with_boxes, "give the filter the boxes of boxes.txt");
  app.add_flag("--movers", arguments.with_movers, "WithMovers<>, whose objects take features that move with them");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? 0 : 2);
  }
  if (folders.empty())
    for (const char* const name : {"kitchen_walk", "kitchen_box", "kitchen_static", "kitchen_round"})
      folders.push_back(std::string(STILLPOINT_SHARED_DATA) + "/" + name);
  arguments.folders.assign(folders.begin(), folders.end());
  return arguments;
}

}  // namespace
}  // namespace stillpoint::bench

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  const stillpoint::bench::Arguments arguments = stillpoint::bench::parse(argc, argv);
  try {
    stillpoint::bench::measure(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stillpoint_conditions: %s\n", error.what());
    return 2;
  }
  return 0;
}
