# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# The targets a host links. They carry include folders, libraries and the language level, and not one flag. To a host that
# adds this project as a subfolder the headers are system headers, as those of an installed package are: its warnings are
# for its own code.

set(STILLPOINT_SYSTEM SYSTEM)
if(PROJECT_IS_TOP_LEVEL)
  set(STILLPOINT_SYSTEM "")
endif()

# stillpoint::core: needs Eigen only.
add_library(stillpoint_core INTERFACE)
add_library(stillpoint::core ALIAS stillpoint_core)
set_target_properties(stillpoint_core PROPERTIES EXPORT_NAME core)
target_compile_features(stillpoint_core INTERFACE cxx_std_17)
target_include_directories(stillpoint_core ${STILLPOINT_SYSTEM} INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
  "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
target_link_libraries(stillpoint_core INTERFACE Eigen3::Eigen)
set(STILLPOINT_COMPONENTS core)

if(STILLPOINT_WITH_OPENCV)
  # stillpoint::stillpoint: the filter, with what needs OpenCV.
  add_library(stillpoint INTERFACE)
  add_library(stillpoint::stillpoint ALIAS stillpoint)
  list(TRANSFORM STILLPOINT_OPENCV_COMPONENTS PREPEND opencv_ OUTPUT_VARIABLE opencv_libraries)
  target_link_libraries(stillpoint INTERFACE stillpoint_core ${opencv_libraries})

  list(APPEND STILLPOINT_COMPONENTS stillpoint)

  if(STILLPOINT_YAML_TARGET)
    # stillpoint::options: options of the stages from and to files.
    add_library(stillpoint_options INTERFACE)
    add_library(stillpoint::options ALIAS stillpoint_options)
    set_target_properties(stillpoint_options PROPERTIES EXPORT_NAME options)
    target_link_libraries(stillpoint_options INTERFACE stillpoint ${STILLPOINT_YAML_TARGET})

    # stillpoint::io: readers and writers of files.
    add_library(stillpoint_io INTERFACE)
    add_library(stillpoint::io ALIAS stillpoint_io)
    set_target_properties(stillpoint_io PROPERTIES EXPORT_NAME io)
    list(TRANSFORM STILLPOINT_IO_OPENCV_COMPONENTS PREPEND opencv_ OUTPUT_VARIABLE opencv_libraries)
    target_link_libraries(stillpoint_io INTERFACE stillpoint ${STILLPOINT_YAML_TARGET} ${opencv_libraries})
    list(APPEND STILLPOINT_COMPONENTS options io)
  endif()

  # stillpoint::dnn: detectors/opencv_dnn.hpp. Some builds of OpenCV are without networks.
  list(TRANSFORM STILLPOINT_DNN_OPENCV_COMPONENTS PREPEND opencv_ OUTPUT_VARIABLE opencv_libraries)
  if(TARGET ${opencv_libraries})
    add_library(stillpoint_dnn INTERFACE)
    add_library(stillpoint::dnn ALIAS stillpoint_dnn)
    set_target_properties(stillpoint_dnn PROPERTIES EXPORT_NAME dnn)
    target_link_libraries(stillpoint_dnn INTERFACE stillpoint ${opencv_libraries})
    list(APPEND STILLPOINT_COMPONENTS dnn)
  endif()

  # stillpoint::compiled: the filter as a library, for hosts with the same compiler flags.
  if(STILLPOINT_BUILD_COMPILED)
    add_subdirectory("${PROJECT_SOURCE_DIR}/cmake/compiled" "${PROJECT_BINARY_DIR}/compiled")
    list(APPEND STILLPOINT_COMPONENTS compiled)
  endif()

  # stillpoint::shim: the compiled front for hosts in C++11. It takes the targets above, and nobody else's.
  if(STILLPOINT_BUILD_SHIM)
    add_subdirectory("${PROJECT_SOURCE_DIR}/shim" "${PROJECT_BINARY_DIR}/shim")
    list(APPEND STILLPOINT_COMPONENTS shim)
  endif()

  # stillpoint::onnxruntime: detectors/onnxruntime.hpp.
  if(STILLPOINT_ONNXRUNTIME)
    add_library(stillpoint_onnxruntime INTERFACE)
    add_library(stillpoint::onnxruntime ALIAS stillpoint_onnxruntime)
    set_target_properties(stillpoint_onnxruntime PROPERTIES EXPORT_NAME onnxruntime)
    target_link_libraries(stillpoint_onnxruntime INTERFACE stillpoint onnxruntime::onnxruntime)
    list(APPEND STILLPOINT_COMPONENTS onnxruntime)
  endif()
endif()
