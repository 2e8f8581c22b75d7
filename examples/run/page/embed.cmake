# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# embed_page(<out.cpp>): writes style and scripts of this folder into a source file; a change of them writes it again.

set(page_folder "${CMAKE_CURRENT_LIST_DIR}")

function(embed_page out)
  set(scripts player.js charts.js turntable.js report.js)
  set(style "")
  set(script "")
  file(READ "${page_folder}/report.css" style)
  foreach(name IN LISTS scripts)
    file(READ "${page_folder}/${name}" text)
    string(APPEND script "${text}")
  endforeach()
  list(TRANSFORM scripts PREPEND "${page_folder}/")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${page_folder}/report.css" ${scripts})
  file(GENERATE OUTPUT "${out}" CONTENT "#include \"run/page/page.hpp\"
namespace stillpoint_run {
const char* const kReportStyle = R\"page(${style})page\";
const char* const kReportScript = R\"page(${script})page\";
}
")
endfunction()
