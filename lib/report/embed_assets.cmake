# SPDX-License-Identifier: MIT
# Puts what every HTML page holds into a source file: our style and script, and dygraphs as Debian installs it.
find_path(DYGRAPHS_FOLDER dygraph.min.js PATHS /usr/share/javascript/dygraphs NO_DEFAULT_PATH)
if(NOT DYGRAPHS_FOLDER)
  message(FATAL_ERROR "dygraphs is missing: install the Debian package libjs-dygraphs (bash apps/install.sh), "
                      "or set DYGRAPHS_FOLDER to a folder with dygraph.min.js and dygraph.min.css")
endif()

set(asset_folder ${CMAKE_CURRENT_SOURCE_DIR}/report)
foreach(asset IN ITEMS
    DYGRAPHS_SCRIPT=${DYGRAPHS_FOLDER}/dygraph.min.js DYGRAPHS_STYLE=${DYGRAPHS_FOLDER}/dygraph.min.css
    PAGE_SCRIPT=${asset_folder}/html_plots.js PAGE_STYLE=${asset_folder}/html_style.css)
  string(REGEX MATCH "^([A-Z_]+)=(.*)$" unused ${asset})
  set(name ${CMAKE_MATCH_1})
  set(file ${CMAKE_MATCH_2})
  file(READ ${file} ${name})
  string(REGEX REPLACE "[\r\n]*//# sourceMappingURL=[^\r\n]*" "" ${name} "${${name}}")
  string(REGEX REPLACE "/\\*# sourceMappingURL=[^*]*\\*/" "" ${name} "${${name}}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
endforeach()
configure_file(${asset_folder}/html_assets.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/html_assets.cpp @ONLY)
set(report_GENERATED ${CMAKE_CURRENT_BINARY_DIR}/html_assets.cpp)
