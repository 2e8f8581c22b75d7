# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# What the library itself needs. Whatever is missing is named with its Debian package; nothing is downloaded.

function(stillpoint_missing what package)
  list(JOIN ARGN "" otherwise)
  message(FATAL_ERROR "stillpoint: ${what} was not found. On Debian or Ubuntu: sudo apt-get install ${package}. ${otherwise}")
endfunction()

find_package(Eigen3 CONFIG QUIET)
if(NOT Eigen3_FOUND OR Eigen3_VERSION VERSION_LESS 3.4)
  stillpoint_missing("Eigen 3.4 or later" libeigen3-dev "Elsewhere, set Eigen3_DIR to the folder of Eigen3Config.cmake.")
endif()

# What the headers of each target include (tests/structure/opencv_components.sh), and what else our own programs do.
set(STILLPOINT_OPENCV_COMPONENTS core imgproc video calib3d)
set(STILLPOINT_IO_OPENCV_COMPONENTS imgcodecs videoio)
set(STILLPOINT_DNN_OPENCV_COMPONENTS dnn)
set(STILLPOINT_DEVELOPER_OPENCV_COMPONENTS "")
if(STILLPOINT_BUILD_TESTS OR STILLPOINT_BUILD_EXAMPLES OR STILLPOINT_BUILD_BENCHMARKS OR STILLPOINT_BUILD_ROS STREQUAL "ON")
  set(STILLPOINT_DEVELOPER_OPENCV_COMPONENTS features2d)
endif()
if(STILLPOINT_WITH_OPENCV)
  find_package(OpenCV 4.6 CONFIG QUIET
    COMPONENTS ${STILLPOINT_OPENCV_COMPONENTS} ${STILLPOINT_IO_OPENCV_COMPONENTS} ${STILLPOINT_DEVELOPER_OPENCV_COMPONENTS}
    OPTIONAL_COMPONENTS ${STILLPOINT_DNN_OPENCV_COMPONENTS})
  if(NOT OpenCV_FOUND)
    stillpoint_missing("OpenCV 4.6 or later" libopencv-dev
      "Elsewhere, set OpenCV_DIR to the folder of OpenCVConfig.cmake. Without OpenCV, -DSTILLPOINT_WITH_OPENCV=OFF leaves "
      "stillpoint::core, for hosts that bring their own matches.")
  endif()
endif()

# What reads YAML, and nothing else. Debian 12 has the target yaml-cpp, later versions yaml-cpp::yaml-cpp.
if(STILLPOINT_WITH_OPENCV)
  find_package(yaml-cpp 0.7 CONFIG QUIET)
  if(TARGET yaml-cpp::yaml-cpp)
    set(STILLPOINT_YAML_TARGET yaml-cpp::yaml-cpp)
  elseif(TARGET yaml-cpp)
    set(STILLPOINT_YAML_TARGET yaml-cpp)
  elseif(STILLPOINT_BUILD_TESTS OR STILLPOINT_BUILD_EXAMPLES OR STILLPOINT_BUILD_BENCHMARKS)
    stillpoint_missing(yaml-cpp libyaml-cpp-dev "Elsewhere, set yaml-cpp_DIR to the folder of yaml-cpp-config.cmake. "
      "Without tests, examples and benchmarks nothing but stillpoint::io and stillpoint::options needs it.")
  else()
    message(STATUS "stillpoint: no targets stillpoint::io and stillpoint::options, because yaml-cpp was not found "
      "(Debian: libyaml-cpp-dev)")
  endif()
endif()

if(STILLPOINT_ONNXRUNTIME)
  if(NOT STILLPOINT_WITH_OPENCV)
    message(FATAL_ERROR "stillpoint: STILLPOINT_ONNXRUNTIME needs STILLPOINT_WITH_OPENCV, which prepares the images")
  endif()
  set(ONNXRUNTIME_ROOT "" CACHE PATH "Where ONNX Runtime is, with include/ and lib/")
  include("${CMAKE_CURRENT_LIST_DIR}/StillpointOnnxRuntime.cmake")
  if(NOT TARGET onnxruntime::onnxruntime)
    message(FATAL_ERROR "stillpoint: ONNX Runtime was not found, and STILLPOINT_ONNXRUNTIME is ON. Set ONNXRUNTIME_ROOT to a "
      "folder with its include/ and lib/, from github.com/microsoft/onnxruntime/releases; or fetch one by: "
      "bash tests/fetch_onnxruntime.sh build/onnxruntime")
  endif()
elseif(PROJECT_IS_TOP_LEVEL)
  message(STATUS "stillpoint: no target stillpoint::onnxruntime, because STILLPOINT_ONNXRUNTIME is OFF")
endif()
