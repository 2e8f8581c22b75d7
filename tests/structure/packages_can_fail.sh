#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# packages_can_fail.sh WORK_FOLDER: packages.sh finds a package that only one of the two lists has.
set -euo pipefail
rules=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/packages.sh
rm -rf "$1" && mkdir -p "$1/examples" && cd "$1"
printf '%s\n' 'RUN apt-get update \' ' && apt-get install -y --no-install-recommends \' '      g++ one two \' ' && true' > Dockerfile
printf '%s\n' 'bash "$root/tests/install_packages.sh" g++ two \' '  one < /dev/null' > examples/demo.sh
bash "$rules" . || { echo 'equal lists were refused'; exit 1; }

sed -i 's/one two/one three/' Dockerfile
bash "$rules" . > found && { echo 'the lists differ and nothing was said'; exit 1; }
diff - found << 'EXPECTED' || { echo 'expected (<) is not what was found (>)'; exit 1; }
Dockerfile:1: not in examples/demo.sh: three
Dockerfile:1: missing, in examples/demo.sh: two
EXPECTED
echo 'all differences were found'
