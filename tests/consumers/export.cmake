# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# Builds and installs exporting/ and then, from where it was moved to, exporting/downstream/. All in the folder BUILD.
# COMPILES: the host links what the library compiles, else its headers alone.

file(REMOVE_RECURSE "${BUILD}")
set(arguments -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
  "-DCMAKE_CXX_FLAGS=${FLAGS} -O1" "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" "-DEigen3_DIR=${EIGEN_DIR}"
  "-DOpenCV_DIR=${OPENCV_DIR}" "-Dyaml-cpp_DIR=${YAML_CPP_DIR}")
function(run)
  execute_process(COMMAND ${CMAKE_COMMAND} ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${arguments} -S "${CMAKE_CURRENT_LIST_DIR}/exporting" -B "${BUILD}/host" "-DLIBRARY=${LIBRARY}"
  "-DCOMPILES=${COMPILES}")
run(--build "${BUILD}/host")
run(--install "${BUILD}/host" --prefix "${BUILD}/before_the_move")
file(RENAME "${BUILD}/before_the_move" "${BUILD}/prefix")

if(NOT EXISTS "${BUILD}/prefix/include/vendored/stillpoint/core.hpp")
  message(FATAL_ERROR "headers were not installed into CMAKE_INSTALL_INCLUDEDIR")
endif()
if(EXISTS "${BUILD}/prefix/include/stillpoint")
  message(FATAL_ERROR "headers were installed beside CMAKE_INSTALL_INCLUDEDIR")
endif()
if(NOT COMPILES AND NOT EXISTS "${BUILD}/prefix/share/cmake/stillpoint/stillpoint-config.cmake")
  message(FATAL_ERROR "a package of headers alone was not installed for every machine")
endif()

run(${arguments} -S "${CMAKE_CURRENT_LIST_DIR}/exporting/downstream" -B "${BUILD}/downstream"
  "-DCMAKE_PREFIX_PATH=${BUILD}/prefix")
run(--build "${BUILD}/downstream")
