// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// stillpoint_tables CSV: reads lines `sequence<TAB>reference<TAB>with<TAB>without` (TUM trajectories) and prints the
// paper's tables 1 to 4 as Markdown; CSV gets all figures. A line with a name alone is a sequence that is not here.

#include "tables.hpp"

#include <cstdio>
#include <exception>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "stillpoint/io/atomic_file.hpp"
#include "stillpoint/io/trajectory_file.hpp"

namespace {

tables::Row row_of(const std::string& line) {
  std::vector<std::string> fields;
  std::stringstream stream(line);
  for (std::string field; std::getline(stream, field, '\t');) fields.push_back(field);
  tables::Row row;
  if (!fields.empty()) row.sequence = fields[0];
  if (fields.size() < 4) return row;
  row.is_here = true;
  const stillpoint::Trajectory reference = stillpoint::read_trajectory(fields[1]);
  row.filtered = tables::errors_of(reference, stillpoint::read_trajectory(fields[2]));
  row.unfiltered = tables::errors_of(reference, stillpoint::read_trajectory(fields[3]));
  return row;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    std::vector<tables::Row> rows;
    for (std::string line; std::getline(std::cin, line);) rows.push_back(row_of(line));
    const std::string text =
        tables::error_table("Table 1: ATE in metres", rows, &tables::Errors::ate_m) +
        tables::error_table("Table 2: RPE of translation, metres in a second", rows, &tables::Errors::rpe_m) +
        tables::error_table("Table 3: RPE of rotation, degrees in a second", rows, &tables::Errors::rpe_deg) +
        tables::comparison_table(rows) + tables::notes(rows);
    std::fputs(text.c_str(), stdout);
    if (count > 1) {
      stillpoint::AtomicFile csv(arguments[1]);
      csv.write(tables::as_csv(rows));
      csv.commit();
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stillpoint_tables: %s\n", error.what());
    return 2;
  }
}
