#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# shim_border.sh LIBRARY: what libstillpoint_shim shows to a host, and what it wants. It shows its border and nothing of
# Eigen or std, which the linker would merge with the host's; it wants no OpenCV, whose version is the host's affair.
set -euo pipefail

offences=$(
  nm -DC --defined-only "$1" | sed -E 's/^[0-9a-f]+ . //' | grep -v '^stillpoint_shim::detail::' | sed 's/^/exported: /' || true
  readelf -d "$1" | grep NEEDED | grep -i opencv || true
)
[[ -z $offences ]] || { printf '%s\n' "$offences"; exit 1; }
[[ $(nm -DC --defined-only "$1" | grep -c stillpoint_shim) -ge 10 ]] || { echo 'the border is not there'; exit 1; }
