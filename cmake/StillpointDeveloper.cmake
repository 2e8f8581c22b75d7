# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# For our own tests, examples and benchmarks. A host that adds this project as a subfolder gets none of it.

if(NOT STILLPOINT_WITH_OPENCV)
  message(FATAL_ERROR "stillpoint: tests, examples and benchmarks need OpenCV; STILLPOINT_WITH_OPENCV is OFF")
endif()

if(PROJECT_IS_TOP_LEVEL)
  find_program(STILLPOINT_CCACHE ccache DOC "Compiler cache, used where it is found")
  mark_as_advanced(STILLPOINT_CCACHE)
  if(STILLPOINT_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${STILLPOINT_CCACHE}")
  endif()
endif()

# What each of our own targets is built with.
add_library(stillpoint_developer INTERFACE)
target_compile_options(stillpoint_developer INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-Wpedantic;-Wconversion;-Wshadow>
  $<$<CXX_COMPILER_ID:Clang,AppleClang>:-Wno-gnu-zero-variadic-macro-arguments>  # GoogleTest's TYPED_TEST_SUITE
  $<$<CXX_COMPILER_ID:MSVC>:/W4;/permissive->)
if(STILLPOINT_WARNINGS_AS_ERRORS)
  target_compile_options(stillpoint_developer INTERFACE
    $<IF:$<CXX_COMPILER_ID:MSVC>,/WX,-Werror>)
endif()
list(TRANSFORM STILLPOINT_DEVELOPER_OPENCV_COMPONENTS PREPEND opencv_ OUTPUT_VARIABLE opencv_libraries)
target_link_libraries(stillpoint_developer INTERFACE ${opencv_libraries})
# Loading all of OpenCV's image and video libraries takes 0.1 s a program: only those load them that use them.
target_link_options(stillpoint_developer INTERFACE
  $<$<AND:$<PLATFORM_ID:Linux>,$<CXX_COMPILER_ID:GNU,Clang>>:-Wl,--as-needed>)
