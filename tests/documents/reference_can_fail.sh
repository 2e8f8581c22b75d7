#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# reference_can_fail.sh WORK_FOLDER DOXYGEN DOXYFILE: with the settings of the reference, doxygen takes a sound header and
# refuses a parameter that the function does not have, and a link to a page that is not there.
set -euo pipefail
rm -rf "$1" && mkdir -p "$1" && cd "$1"

head_of_page=$'/// A file.\n/// @file\n#pragma once\n'
printf '%s' "$head_of_page" > sound.hpp
cat >> sound.hpp << 'HEADER'
/// Twice as much.
/// @param metres  any length
inline double twice(double metres, int unused) { return 2 * metres + 0 * unused; }
HEADER
sed 's/@param metres/@param meters/' sound.hpp > wrong_parameter.hpp
printf '# A page\n[nowhere](no_such_page.md)\n' > wrong_link.md

run() { (cat "$doxyfile" && printf '%s\n' "INPUT = $1" 'OUTPUT_DIRECTORY = .' 'USE_MDFILE_AS_MAINPAGE =') | "$doxygen" - 2>&1; }
doxygen=$2 doxyfile=$3
run sound.hpp || { echo 'a sound header was refused'; exit 1; }
for page in wrong_parameter.hpp wrong_link.md; do
  if found=$(run $page); then echo "$page was taken"; exit 1; fi
  [[ $found == *"$page:"* ]] || { printf 'expected a warning of %s, found:\n%s\n' "$page" "$found"; exit 1; }
done
echo 'all mistakes were found'
