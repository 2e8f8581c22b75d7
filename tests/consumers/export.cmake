# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# Builds and installs exporting/ and then, from where it was moved to, exporting/downstream/. All in the folder BUILD.

file(REMOVE_RECURSE "${BUILD}")
set(arguments -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}"
  "-DEigen3_DIR=${EIGEN_DIR}" "-DOpenCV_DIR=${OPENCV_DIR}")
function(run)
  execute_process(COMMAND ${CMAKE_COMMAND} ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${arguments} -S "${CMAKE_CURRENT_LIST_DIR}/exporting" -B "${BUILD}/host" "-DLIBRARY=${LIBRARY}")
run(--build "${BUILD}/host")
run(--install "${BUILD}/host" --prefix "${BUILD}/before_the_move")
file(RENAME "${BUILD}/before_the_move" "${BUILD}/prefix")

foreach(file include/vendored/stillpoint/core.hpp share/cmake/stillpoint/stillpoint-config.cmake)
  if(NOT EXISTS "${BUILD}/prefix/${file}")
    message(FATAL_ERROR "${file} was not installed")
  endif()
endforeach()
if(EXISTS "${BUILD}/prefix/include/stillpoint")
  message(FATAL_ERROR "headers were installed beside CMAKE_INSTALL_INCLUDEDIR")
endif()

run(${arguments} -S "${CMAKE_CURRENT_LIST_DIR}/exporting/downstream" -B "${BUILD}/downstream"
  "-DCMAKE_PREFIX_PATH=${BUILD}/prefix")
run(--build "${BUILD}/downstream")
