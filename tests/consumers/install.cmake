# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# Installs BUILD and then moves it to PREFIX: what is installed may not know where it was.

file(REMOVE_RECURSE "${PREFIX}" "${PREFIX}_before_the_move")
execute_process(COMMAND ${CMAKE_COMMAND} --install "${BUILD}" --prefix "${PREFIX}_before_the_move"
  COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
file(RENAME "${PREFIX}_before_the_move" "${PREFIX}")
