#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# snippets.sh PAGE.md: each block of the page that is fenced by ```cpp is code of a program that runs. A line before it,
# `<!-- snippet: FILE [NAME] -->`, says of which: the block is what stands in FILE between lines `// [NAME]`, line for line
# without the indentation. Its #include lines stand anywhere in FILE. FILE is relative to the working folder.
# Prints `page:line: ...` for each offence; exit status 1.
set -euo pipefail

awk '
  function offence(line, text) { print FILENAME ":" line ": " text; failed = 1 }
  function without_indentation(text) { sub(/^[ \t]+/, "", text); return text }

  # Reads the marked lines of the file into `marked`, and its #include lines into `includes`.
  function read_source(    line, inside) {
    split("", marked); split("", includes)
    marked_count = marks = 0
    while ((getline line < file) > 0) {
      line = without_indentation(line)
      if (line == "// [" name "]") { inside = !inside; ++marks; continue }
      if (line ~ /^#include/) includes[line]
      if (inside && line != "") marked[++marked_count] = line
    }
    close(file)
    if (marks == 0) offence(source_line, "no line \"// [" name "]\" in " file)
    else if (inside) offence(source_line, "an odd number of lines \"// [" name "]\" in " file)
    return marks > 0 && !inside
  }

  /^<!-- snippet: .* \[.*\] -->$/ {
    file = $3
    name = substr($4, 2, length($4) - 2)
    source_line = FNR
    is_named = 1
    next
  }
  !is_inside && /^[ \t]*```cpp[ \t]*$/ {
    is_inside = 1
    count = 0
    has_source = is_named && read_source()
    if (!is_named) offence(FNR, "a block of code without a line <!-- snippet: FILE [NAME] --> before it")
    is_named = 0
    next
  }
  is_inside && /^[ \t]*```[ \t]*$/ {
    is_inside = 0
    if (has_source && count < marked_count)
      offence(FNR, "expected " file " [" name "] to go on with \"" marked[count + 1] "\"")
    next
  }
  is_inside && has_source {
    line = without_indentation($0)
    if (line == "") next
    if (line ~ /^#include/) {
      if (!(line in includes)) offence(FNR, file " has no line \"" line "\"")
      next
    }
    ++count
    if (count > marked_count) offence(FNR, file " [" name "] has ended, found \"" line "\"")
    else if (line != marked[count]) offence(FNR, "found \"" line "\", expected \"" marked[count] "\" of " file)
  }
  END { exit failed }' "$1"
