#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# packages.sh PROJECT: the Dockerfile installs the packages that examples/demo.sh asks for. Prints each that only one of
# them names.
set -euo pipefail
cd "$1"

# packages_of FILE COMMAND: the words that follow COMMAND in FILE, up to the end of the command; no options, no quotes.
packages_of() {
  sed -e ':join' -e '/\\$/{N;s/\\\n//;bjoin}' "$1" | sed -nE "s|.*$2||p" | sed -E 's/(&&|<|;).*//' | tr -s ' ' '\n' |
    grep -E '^[a-z0-9]' | LC_ALL=C sort -u
}
offences=$({ diff <(packages_of Dockerfile 'apt-get install') <(packages_of examples/demo.sh 'install_packages[.]sh') || true; } |
  sed -nE 's|^< (.*)|Dockerfile:1: not in examples/demo.sh: \1|p; s|^> (.*)|Dockerfile:1: missing, in examples/demo.sh: \1|p')
[[ -z $offences ]] || { printf '%s\n' "$offences"; exit 1; }
