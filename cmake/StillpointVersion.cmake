# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# Reads STILLPOINT_VERSION from version.hpp, the one place where it is written.

set(version_header "${CMAKE_CURRENT_LIST_DIR}/../include/stillpoint/version.hpp")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${version_header}")
file(READ "${version_header}" version_text)

foreach(part MAJOR MINOR PATCH)
  if(NOT version_text MATCHES "#define STILLPOINT_VERSION_${part} ([0-9]+)")
    message(FATAL_ERROR "${version_header}: no line '#define STILLPOINT_VERSION_${part} <number>'")
  endif()
  list(APPEND version_parts ${CMAKE_MATCH_1})
endforeach()
list(JOIN version_parts "." STILLPOINT_VERSION)

if(NOT version_text MATCHES "#define STILLPOINT_VERSION \"${STILLPOINT_VERSION}\"")
  message(FATAL_ERROR "${version_header}: STILLPOINT_VERSION is not \"${STILLPOINT_VERSION}\", as its parts say")
endif()
unset(version_header)
unset(version_text)
unset(version_parts)
