#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# run.sh WORK_FOLDER PYTHON REFERENCE_PROGRAM: `pip install .` into a new environment, without a network, then pytest and
# the example. REFERENCE_PROGRAM is that of reference.cpp. What the build of the tests has compiled by the same command
# comes from ccache.
set -euo pipefail
work=$1 python=$2 reference=$3
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
rm -rf "$work" && mkdir -p "$work"

recorded=()
[[ ! -d ${STILLPOINT_SHARED_DATA:-} ]] || recorded=("$STILLPOINT_SHARED_DATA/kitchen_walk")
"$reference" "$work/reference" "${recorded[@]}"
"$python" -m venv --system-site-packages --without-pip "$work/venv"  # pip is the system's
python=$work/venv/bin/python
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_ROOT_USER_ACTION=ignore PYTHONDONTWRITEBYTECODE=1
"$python" -m pip install --quiet --no-index --no-build-isolation "$project"

cd "$work"  # the package that is installed is the one that is tested
STILLPOINT_REFERENCE=$work/reference "$python" -m pytest -q -p no:cacheprovider "$project/tests/python"
bash "$project/tests/examples/prints.sh" \
  '1[.]000000: 8[0-9][0-9] of 8[0-9][0-9] features are static, 0 matches .first_frame. ' \
  '1[.]300000: (7[0-9][0-9]|80[0-9]) of 8[0-9][0-9] features are static, [67][0-9][0-9] matches .ok. ' \
  -- "$python" "$project/examples/python/tum_folder.py" "$work/reference"
