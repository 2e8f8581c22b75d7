#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# host_diff.sh DIFF HOST.cpp -- COMPILER FLAG...: the change of a host (docs/hosts/) holds our lines alone, and these compile
# in HOST.cpp, a host of ours whose lines `//@ FILE NUMBER` stand for that hunk of that file (files of CMake have none). An
# error names the diff's line.
set -euo pipefail
diff=$1 host=$2
shift 3

offences=$(awk '
  /^--- /     { in_hunks = 0; next }
  /^\+\+\+ /  { in_hunks = 1; next }
  !in_hunks || /^@@ / || /^\+/ { next }
  /^-/        { if (++removed > 1) print FILENAME ":" FNR ": a second line of the host is removed: add, do not change"; next }
              { print FILENAME ":" FNR ": a line of the host as context: diff -U0 has none" }' "$diff")
[[ -z $offences ]] || { printf '%s\n' "$offences"; exit 1; }

awk '
  function take(key,  text) { text = hunks[key]; if (text == "") missing = missing " " key; delete hunks[key]; return text }
  FNR == NR && /^--- /    { inside = 0; next }
  FNR == NR && /^\+\+\+ / { file = substr($2, 3); count = 0; inside = 1; next }
  FNR == NR && /^@@ /     { key = file " " ++count; hunks[key] = "#line " FNR + 1 " \"" FILENAME "\"\n"; next }
  FNR == NR && /^-/ && inside { hunks[key] = "#line " FNR + 1 " \"" FILENAME "\"\n"; next }
  FNR == NR               { if (inside) hunks[key] = hunks[key] substr($0, 2) "\n"; next }
  /^ *\/\/@ /             { printf "%s#line %d \"%s\"\n", take($2 " " $3), FNR + 1, FILENAME; next }
                          { print }
  END {
    if (missing != "") { print "#error no such hunk in the diff:" missing }
    for (key in hunks) if (key !~ /LoopClosing|[.]cmake|CMakeLists/) print "#error hunk of the diff that the host has no place for: " key
  }' "$diff" "$host" | "$@" -fsyntax-only -x c++ -
