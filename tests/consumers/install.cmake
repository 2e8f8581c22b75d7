# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# Installs BUILD and then moves it to PREFIX: what is installed may not know where it was.

file(REMOVE_RECURSE "${PREFIX}" "${PREFIX}_before_the_move")
execute_process(COMMAND ${CMAKE_COMMAND} --install "${BUILD}" --prefix "${PREFIX}_before_the_move"
  COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
file(RENAME "${PREFIX}_before_the_move" "${PREFIX}")

# What was built as a program is there and runs.
if(HAS_PROGRAM)
  execute_process(COMMAND "${PREFIX}/bin/stillpoint_run" --version COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endif()

# A package with a library in it is refused by hosts for other machines: not by their CMake, by its own version file.
file(GLOB_RECURSE version_files "${PREFIX}/*stillpoint-config-version.cmake")
list(LENGTH version_files count)
if(NOT count EQUAL 1)
  message(FATAL_ERROR "one package was expected, not '${version_files}'")
endif()
get_filename_component(package_dir "${version_files}" DIRECTORY)
file(READ "${version_files}" version_file)
file(GLOB libraries "${package_dir}/stillpoint-shim.cmake" "${package_dir}/stillpoint-compiled.cmake")
if(libraries AND (NOT version_file MATCHES "CMAKE_SIZEOF_VOID_P STREQUAL" OR package_dir MATCHES "/share/"))
  message(FATAL_ERROR "${version_files} says that its libraries are for every machine")
endif()

# Whatever else the package looks for has a version.
file(STRINGS "${package_dir}/stillpoint-config.cmake" lookups REGEX "^ *find_(dependency|package)\\(")
foreach(lookup IN LISTS lookups)
  if(NOT lookup MATCHES "\\([A-Za-z0-9-]+ [0-9]+(\\.[0-9]+)* ")
    message(FATAL_ERROR "without a version: ${lookup}")
  endif()
endforeach()
