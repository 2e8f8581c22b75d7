# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# cmake --build <folder> --target stillpoint_docs: the reference, from the comments in the headers, with the documents. It
# fails at a warning: a name that is not there, a parameter that is called otherwise.

find_package(Doxygen QUIET)
if(NOT Doxygen_FOUND)
  message(STATUS "stillpoint: doxygen was not found (Debian: doxygen), no target stillpoint_docs")
  return()
endif()

set(DOXYGEN_FULL_PATH_NAMES YES)
set(DOXYGEN_STRIP_FROM_PATH "${PROJECT_SOURCE_DIR}/include" "${PROJECT_SOURCE_DIR}/shim/include" "${PROJECT_SOURCE_DIR}")
set(DOXYGEN_STRIP_FROM_INC_PATH "${PROJECT_SOURCE_DIR}/include" "${PROJECT_SOURCE_DIR}/shim/include")
set(DOXYGEN_IMAGE_PATH "${PROJECT_SOURCE_DIR}/docs")
set(DOXYGEN_FILE_PATTERNS "*.hpp;*.md")
set(DOXYGEN_EXCLUDE_SYMBOLS "*::detail")
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_EXTRACT_ALL YES)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_FILTER_PATTERNS "\"*.md=sed -E -f '${PROJECT_SOURCE_DIR}/cmake/links_within_pages.sed'\"")
set(DOXYGEN_VERBATIM_VARS DOXYGEN_FILTER_PATTERNS)
# A comment may leave out a parameter that its type and name explain; what it says has to be true.
set(DOXYGEN_WARN_IF_INCOMPLETE_DOC NO)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)

option(STILLPOINT_DOCS_WITH_GUIDES "The reference has the guides as pages, too; docs/site.sh has them beside it" ON)
mark_as_advanced(STILLPOINT_DOCS_WITH_GUIDES)
set(guides "")
if(STILLPOINT_DOCS_WITH_GUIDES)
  set(DOXYGEN_USE_MDFILE_AS_MAINPAGE "${PROJECT_SOURCE_DIR}/README.md")
  set(guides README.md CONTRIBUTING.md docs shim/README.md)
endif()
doxygen_add_docs(stillpoint_docs ${guides} include shim/include
  WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}" COMMENT "Reference of stillpoint")

if(STILLPOINT_BUILD_TESTS)
  set(doxyfile "${CMAKE_CURRENT_BINARY_DIR}/Doxyfile.stillpoint_docs")  # made by doxygen_add_docs
  add_test(NAME documents.reference COMMAND Doxygen::doxygen "${doxyfile}" WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
  set_tests_properties(documents.reference PROPERTIES LABELS documents TIMEOUT 120)
  if(STILLPOINT_BASH)
    add_test(NAME documents.reference_can_fail COMMAND "${STILLPOINT_BASH}"
      "${PROJECT_SOURCE_DIR}/tests/documents/reference_can_fail.sh" "${CMAKE_CURRENT_BINARY_DIR}/reference_can_fail"
      "$<TARGET_FILE:Doxygen::doxygen>" "${doxyfile}")
    set_tests_properties(documents.reference_can_fail PROPERTIES LABELS documents TIMEOUT 60)
  endif()
endif()
