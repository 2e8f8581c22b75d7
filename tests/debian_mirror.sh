#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# debian_mirror.sh: prints the address from which this machine's apt gets Debian's packages, on one line.
set -euo pipefail

addresses=$(apt-get indextargets --format '$(SITE)' 'Identifier: Packages' 'Label: Debian' 'Component: main')
[[ -n $addresses ]] || {
  echo 'apt knows no address of Debian: run `apt-get update`, or say --mirror ADDRESS' >&2
  exit 1
}
head -n 1 <<< "$addresses"
