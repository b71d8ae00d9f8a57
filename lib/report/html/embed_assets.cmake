# SPDX-License-Identifier: MIT
# Puts what every HTML page holds into a source file: our style and script, and dygraphs as Debian installs it.
find_path(DYGRAPHS_FOLDER dygraph.min.js PATHS /usr/share/javascript/dygraphs NO_DEFAULT_PATH)
if(NOT DYGRAPHS_FOLDER)
  message(FATAL_ERROR "dygraphs is missing: install the Debian package libjs-dygraphs (bash apps/install.sh), "
                      "or set DYGRAPHS_FOLDER to a folder with dygraph.min.js and dygraph.min.css")
endif()

set(asset_folder ${CMAKE_CURRENT_SOURCE_DIR}/report/html)

# Appends a file to a variable, without what browsers would look for beside it.
function(append_asset name file)
  file(READ ${file} content)
  string(REGEX REPLACE "[\r\n]*//# sourceMappingURL=[^\r\n]*" "" content "${content}")
  string(REGEX REPLACE "/\\*# sourceMappingURL=[^*]*\\*/" "" content "${content}")
  set(${name} "${${name}}${content}" PARENT_SCOPE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
endfunction()

append_asset(DYGRAPHS_SCRIPT ${DYGRAPHS_FOLDER}/dygraph.min.js)
append_asset(DYGRAPHS_STYLE ${DYGRAPHS_FOLDER}/dygraph.min.css)
append_asset(PAGE_SCRIPT ${asset_folder}/series.js)
append_asset(PAGE_SCRIPT ${asset_folder}/plots.js)
append_asset(PAGE_SCRIPT ${asset_folder}/page.js)
append_asset(PAGE_STYLE ${asset_folder}/style.css)
foreach(concern tables timeline plots print)
  append_asset(PAGE_STYLE ${asset_folder}/style/${concern}.css)
endforeach()
configure_file(${asset_folder}/assets.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/html_assets.cpp @ONLY)
set(report_GENERATED ${CMAKE_CURRENT_BINARY_DIR}/html_assets.cpp)
