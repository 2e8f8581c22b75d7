# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# After the library was added: nothing of the host's is other than before.

if(CMAKE_BUILD_TYPE OR DEFINED BUILD_TESTING OR
   NOT "${CMAKE_CXX_STANDARD}" STREQUAL "${standard_before}" OR NOT CMAKE_CXX_FLAGS STREQUAL flags_before)
  message(FATAL_ERROR "the library set CMAKE_BUILD_TYPE '${CMAKE_BUILD_TYPE}', BUILD_TESTING '${BUILD_TESTING}', "
    "CMAKE_CXX_STANDARD '${CMAKE_CXX_STANDARD}' or CMAKE_CXX_FLAGS '${CMAKE_CXX_FLAGS}'")
endif()

get_cmake_property(new_variables CACHE_VARIABLES)
list(REMOVE_ITEM new_variables ${variables_before})
# CMAKE_ and _GNUInstallDirs_ are of CMake's own modules.
list(FILTER new_variables EXCLUDE REGEX "^(_GNUInstallDirs_|STILLPOINT_|stillpoint_|FETCHCONTENT_|FIND_PACKAGE_MESSAGE_|OpenCV_|Eigen3_|yaml-cpp_|CMAKE_)")
if(COMPONENT STREQUAL "onnxruntime")
  list(FILTER new_variables EXCLUDE REGEX "^(ONNXRUNTIME_|onnxruntime_DIR)")
endif()
if(new_variables)
  message(FATAL_ERROR "the library added to the host's cache: ${new_variables}")
endif()

# Where it is a subfolder, it has its interface targets and nothing to build but the shim, if that was asked for.
set(folder "")
if(WAY STREQUAL "add_subdirectory")
  set(folder "${LIBRARY}")
elseif(WAY STREQUAL "fetch_content")
  set(folder "${stillpoint_SOURCE_DIR}")
endif()
if(folder)
  get_property(subfolders DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  if(COMPONENT STREQUAL "shim")
    list(REMOVE_ITEM subfolders "${folder}/shim")
  elseif(COMPONENT STREQUAL "compiled")
    list(REMOVE_ITEM subfolders "${folder}/cmake/compiled")
  endif()
  list(REMOVE_ITEM targets stillpoint stillpoint_core stillpoint_options stillpoint_io stillpoint_dnn stillpoint_onnxruntime)
  if(subfolders OR targets)
    message(FATAL_ERROR "the library brought along ${targets} ${subfolders}")
  endif()
endif()

# To the host these are headers of the system.
if(folder AND TARGET stillpoint::core)
  get_target_property(system_folders stillpoint::core INTERFACE_SYSTEM_INCLUDE_DIRECTORIES)
  if(NOT system_folders MATCHES "${LIBRARY}/include")
    message(FATAL_ERROR "system include folders are '${system_folders}', without the library's")
  endif()
endif()

# What a host links carries no flags.
foreach(component core stillpoint options io dnn onnxruntime shim)
  if(TARGET stillpoint::${component})
    foreach(property COMPILE_OPTIONS COMPILE_DEFINITIONS LINK_OPTIONS)
      get_target_property(value stillpoint::${component} INTERFACE_${property})
      if(value)
        message(FATAL_ERROR "stillpoint::${component} has ${property} '${value}'")
      endif()
    endforeach()
  endif()
endforeach()
if(COMPONENT STREQUAL "core" AND TARGET stillpoint::stillpoint)
  message(FATAL_ERROR "core was asked for, and stillpoint::stillpoint came along")
endif()
if((COMPONENT STREQUAL "core" OR COMPONENT STREQUAL "stillpoint") AND WAY STREQUAL "find_package" AND
   (TARGET yaml-cpp OR TARGET yaml-cpp::yaml-cpp))
  message(FATAL_ERROR "${COMPONENT} was asked for, and yaml-cpp came along")
endif()
if(COMPONENT STREQUAL "shim" AND WAY STREQUAL "find_package" AND (TARGET Eigen3::Eigen OR TARGET opencv_core))
  message(FATAL_ERROR "shim was asked for, and Eigen or OpenCV came along")
endif()
