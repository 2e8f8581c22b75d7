# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# cmake --build <folder> --target stillpoint_docs: the reference, from the comments in the headers.

find_package(Doxygen QUIET)
if(NOT Doxygen_FOUND)
  message(STATUS "stillpoint: doxygen was not found (Debian: doxygen), no target stillpoint_docs")
  return()
endif()

set(DOXYGEN_STRIP_FROM_PATH "${PROJECT_SOURCE_DIR}/include")
set(DOXYGEN_EXCLUDE_SYMBOLS "*::detail")
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_EXTRACT_ALL YES)
set(DOXYGEN_QUIET YES)
doxygen_add_docs(stillpoint_docs "${PROJECT_SOURCE_DIR}/include" COMMENT "Reference of stillpoint")
