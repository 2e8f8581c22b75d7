# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# Configures project/ afresh in BUILD, builds it and runs its programs. WAY: how it gets the library; COMPONENT: which
# target it links; EVERY: its slower programs, too; STANDARD: of C++, if not the compiler's own. For `core` OpenCV is hidden.

file(REMOVE_RECURSE "${BUILD}")
set(arguments "-DWAY=${WAY}" "-DCOMPONENT=${COMPONENT}" "-DEVERY=${EVERY}" "-DLIBRARY=${LIBRARY}"
  "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
  "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" "-DEigen3_DIR=${EIGEN_DIR}")
if(WAY STREQUAL "find_package")
  list(APPEND arguments "-DCMAKE_PREFIX_PATH=${PREFIX}" "-DLIBRARY_VERSION=${VERSION}")
endif()
if(COMPONENT STREQUAL "core")
  list(APPEND arguments -DCMAKE_DISABLE_FIND_PACKAGE_OpenCV=ON)
else()
  list(APPEND arguments "-DOpenCV_DIR=${OPENCV_DIR}")
endif()
# Only who asks for what reads YAML finds yaml-cpp.
if(COMPONENT STREQUAL "options" OR COMPONENT STREQUAL "io")
  list(APPEND arguments "-Dyaml-cpp_DIR=${YAML_CPP_DIR}")
else()
  list(APPEND arguments -DCMAKE_DISABLE_FIND_PACKAGE_yaml-cpp=ON)
endif()
if(COMPONENT STREQUAL "onnxruntime")
  list(APPEND arguments "-DONNXRUNTIME_ROOT=${ONNXRUNTIME_ROOT}")
endif()
if(STANDARD)
  list(APPEND arguments "-DCMAKE_CXX_STANDARD=${STANDARD}" -DCMAKE_CXX_STANDARD_REQUIRED=ON -DCMAKE_CXX_EXTENSIONS=OFF)
endif()
unset(ENV{CXXFLAGS})  # those of the library's compiler, which are in FLAGS as well
if(NOT COMPILER MATCHES "clang")  # as the library was; without -O1 g++ takes longer, for all that it then writes out
  list(APPEND arguments "-DCMAKE_CXX_FLAGS=${FLAGS} -O1")
elseif(COMPONENT STREQUAL "compiled")  # of the flags of the library's compiler those that make the same ABI
  string(REGEX MATCHALL " -m[^ ]+" machine_flags " ${FLAGS}")
  list(JOIN machine_flags "" machine_flags)
  list(APPEND arguments "-DCMAKE_CXX_FLAGS=${machine_flags}")
endif()
unset(ENV{CMAKE_BUILD_TYPE})

execute_process(
  COMMAND ${CMAKE_COMMAND} -G "${GENERATOR}" -S "${CMAKE_CURRENT_LIST_DIR}/project" -B "${BUILD}" ${arguments}
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build "${BUILD}" COMMAND_ERROR_IS_FATAL ANY)

# A host that the library was not compiled for does not link, and the message says what it has.
if(EXISTS "${BUILD}/mismatches.txt")
  file(STRINGS "${BUILD}/mismatches.txt" mismatches)
  foreach(mismatch IN LISTS mismatches)
    string(REGEX MATCH "^([^:]*):(.*)$" matched "${mismatch}")
    set(expected "${CMAKE_MATCH_2}")
    execute_process(COMMAND ${CMAKE_COMMAND} --build "${BUILD}" --target "${CMAKE_MATCH_1}"
      RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(status EQUAL 0 OR NOT output MATCHES "undefined [^\n]*HostAbi<[^\n]*${expected}")
      message(FATAL_ERROR "${mismatch}: status ${status}, expected a link error that names it\n${output}")
    endif()
  endforeach()
endif()

file(STRINGS "${BUILD}/programs.txt" programs)
foreach(program IN LISTS programs)
  execute_process(COMMAND "${program}" WORKING_DIRECTORY "${BUILD}" OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  message("${program}: ${output}")
  if(NOT output MATCHES "kept [0-9]+ of [0-9]+")
    message(FATAL_ERROR "expected 'kept <number> of <number>'")
  endif()
endforeach()
