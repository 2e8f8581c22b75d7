#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# bench/conditions.sh [FOLDER...] [OPTION...]: recall, false-positive rate, error of the filter's own motion and of a
# tracker behind it under each condition of bench/degradations.hpp. FOLDERs are labelled recordings in the layout of the
# TUM benchmark, unless told the kitchen sequences of ../shared/data; `bench/conditions.sh --help` lists the options.
# Prints one table in Markdown. Without options some 40 minutes on two free cores.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

bash "$root/bench/build.sh" stillpoint_conditions
"$root/build/ratios/bench/stillpoint_conditions" "$@"
