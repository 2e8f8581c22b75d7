#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# prints_can_fail.sh: prints.sh takes a program that prints the lines in order and refuses other ones.
set -euo pipefail
prints=$(dirname "${BASH_SOURCE[0]}")/prints.sh
good=(bash -c 'echo first 12; echo; echo second; echo third')

bash "$prints" 'first 1[0-9]' second -- "${good[@]}" || { echo 'sound lines were refused'; exit 1; }
refuses() {
  if bash "$prints" "$@" > /dev/null; then echo "taken: $1"; exit 1; fi
}
refuses 'first 2[0-9]' -- "${good[@]}"
refuses second 'first 12' -- "${good[@]}"   # the wrong order
refuses second second -- "${good[@]}"       # once alone
refuses first -- "${good[@]}"               # a part of the line
refuses first -- bash -c 'echo first; exit 3'
refuses first -- true
echo 'all mistakes were found'
