# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# cmake [-DNAMES=STAGE,OTHER] -P first_error.cmake -- COMMAND...: runs a compiler and prints its first error as one line
# `first error: ...`, and how many there were. With NAMES one line beside it must name both stages.

math(EXPR last "${CMAKE_ARGC} - 1")
set(command "")
set(begun FALSE)
foreach(i RANGE ${last})
  if(begun)
    list(APPEND command "${CMAKE_ARGV${i}}")
  elseif("${CMAKE_ARGV${i}}" STREQUAL "--")
    set(begun TRUE)
  endif()
endforeach()

set(ENV{LC_ALL} C)  # plain English messages with plain quotes
execute_process(COMMAND ${command} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(status EQUAL 0)
  message("it compiles")
elseif(output MATCHES "error: ([^\n]*)")
  set(first "${CMAKE_MATCH_1}")
  string(REPLACE "," ", [^\n<>]*" both "${NAMES}")
  if(NAMES AND NOT output MATCHES "meets<[^\n<>]*${both}")
    message("no line names both of ${NAMES}:\n${output}")
    return()
  endif()
  string(REGEX MATCHALL "error: " errors "${output}")
  list(LENGTH errors count)
  message("first error: ${first}\nerrors: ${count}")
else()
  message("no error, but status ${status}:\n${output}")
endif()
