# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# Defines the target onnxruntime::onnxruntime if ONNX Runtime is found: in ONNXRUNTIME_ROOT alone where that is set, by its
# package (newer distributions, its own installation) or by header and library. Is installed, for hosts look for it too.

if(ONNXRUNTIME_ROOT)
  get_filename_component(stillpoint_onnxruntime_root "${ONNXRUNTIME_ROOT}" ABSOLUTE BASE_DIR "${CMAKE_SOURCE_DIR}")
  set(stillpoint_onnxruntime_places PATHS "${stillpoint_onnxruntime_root}" NO_DEFAULT_PATH)
endif()
if(NOT TARGET onnxruntime::onnxruntime)
  find_package(onnxruntime CONFIG QUIET ${stillpoint_onnxruntime_places})
endif()
if(NOT TARGET onnxruntime::onnxruntime)
  find_path(ONNXRUNTIME_INCLUDE_DIR onnxruntime_cxx_api.h ${stillpoint_onnxruntime_places}
    PATH_SUFFIXES include include/onnxruntime onnxruntime include/onnxruntime/core/session onnxruntime/core/session
    DOC "Folder of onnxruntime_cxx_api.h")
  find_library(ONNXRUNTIME_LIBRARY NAMES onnxruntime libonnxruntime.so.1 ${stillpoint_onnxruntime_places}
    PATH_SUFFIXES lib lib64 DOC "The library ONNX Runtime")
  mark_as_advanced(ONNXRUNTIME_INCLUDE_DIR ONNXRUNTIME_LIBRARY)
  if(ONNXRUNTIME_INCLUDE_DIR AND ONNXRUNTIME_LIBRARY)
    add_library(onnxruntime::onnxruntime UNKNOWN IMPORTED)
    set_target_properties(onnxruntime::onnxruntime PROPERTIES
      IMPORTED_LOCATION "${ONNXRUNTIME_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${ONNXRUNTIME_INCLUDE_DIR}")
  endif()
endif()
unset(stillpoint_onnxruntime_root)
unset(stillpoint_onnxruntime_places)
