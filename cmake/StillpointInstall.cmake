# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# find_package(stillpoint 0.2 [COMPONENTS core|stillpoint|options|io|dnn|compiled|onnxruntime|shim]): one export set a component, so that a
# host that asks for `core` never looks for OpenCV.

include(CMakePackageConfigHelpers)

# A package of headers alone is for every machine; with a library in it, for machines like this one.
set(package_dir "${CMAKE_INSTALL_DATADIR}/cmake/stillpoint")
set(package_machines ARCH_INDEPENDENT)
if(TARGET stillpoint_shim OR TARGET stillpoint_compiled)
  set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/stillpoint")
  set(package_machines "")
endif()
# The major version of Eigen that this was built with: its packages of another one do not answer to it.
set(package_eigen_version 3.4)
if(Eigen3_VERSION_MAJOR GREATER 3)
  set(package_eigen_version ${Eigen3_VERSION_MAJOR})
endif()
list(JOIN STILLPOINT_OPENCV_COMPONENTS " " package_opencv_components)
list(JOIN STILLPOINT_IO_OPENCV_COMPONENTS " " package_io_opencv_components)
list(JOIN STILLPOINT_DNN_OPENCV_COMPONENTS " " package_dnn_opencv_components)
list(JOIN STILLPOINT_COMPONENTS " " package_components)

install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/stillpoint" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING PATTERN "*.hpp")
if(TARGET stillpoint_shim)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/shim/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
    FILES_MATCHING PATTERN "*.hpp")
endif()
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/stillpoint")

set(component_targets_core stillpoint_core)
set(component_targets_stillpoint stillpoint)
set(component_targets_options stillpoint_options)
set(component_targets_io stillpoint_io)
set(component_targets_dnn stillpoint_dnn)
set(component_targets_onnxruntime stillpoint_onnxruntime)
set(component_targets_shim stillpoint_shim)
set(component_targets_compiled stillpoint_compiled)
foreach(component IN LISTS STILLPOINT_COMPONENTS)
  install(TARGETS ${component_targets_${component}} EXPORT stillpoint-${component})
  install(EXPORT stillpoint-${component} NAMESPACE stillpoint:: DESTINATION "${package_dir}")
endforeach()

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/stillpoint-config.cmake.in"
  "${PROJECT_BINARY_DIR}/stillpoint-config.cmake" INSTALL_DESTINATION "${package_dir}"
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/stillpoint-config-version.cmake"
  COMPATIBILITY SameMinorVersion ${package_machines})
install(FILES "${PROJECT_BINARY_DIR}/stillpoint-config.cmake" "${PROJECT_BINARY_DIR}/stillpoint-config-version.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/StillpointOnnxRuntime.cmake" DESTINATION "${package_dir}")
