# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# For our own tests, examples and benchmarks. A host that adds this project as a subfolder gets none of it.

if(NOT STILLPOINT_WITH_OPENCV)
  message(FATAL_ERROR "stillpoint: tests, examples, benchmarks and the ROS nodes need OpenCV, and STILLPOINT_WITH_OPENCV "
    "is OFF; set STILLPOINT_BUILD_TESTS, _EXAMPLES, _BENCHMARKS and _ROS to OFF")
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
