# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""python -m stillpoint: the program stillpoint_run, which lies beside this file."""

import os
import pathlib
import sys

PROGRAM = pathlib.Path(__file__).with_name("stillpoint_run")

if __name__ == "__main__":
    if not PROGRAM.is_file():
        sys.exit("stillpoint: this package was built without stillpoint_run (STILLPOINT_BUILD_EXAMPLES=OFF)")
    # In place of the interpreter: signals, output and exit status are the program's own.
    os.execv(PROGRAM, ["stillpoint_run", *sys.argv[1:]])
