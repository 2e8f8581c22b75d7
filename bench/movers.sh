#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# bench/movers.sh [NAME...]: movers against the true poses of objects: share of frames in which each is found, switches
# of its identifier, error of its pose carried over a second, of its speed, relative pose error, share of the filter's
# time. NAMEs are kitchen sequences of ../shared/data or synthetic scenes, NAME+boxes the same with a detector's boxes;
# without any, those of docs/movers.md. Prints one table in Markdown. About four minutes.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

bash "$root/bench/build.sh" stillpoint_movers
"$root/build/ratios/bench/stillpoint_movers" "$@"
