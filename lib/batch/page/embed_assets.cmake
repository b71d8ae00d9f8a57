# SPDX-License-Identifier: MIT
# Puts the style and the script of a batch's index into a source file.
set(batch_assets ${CMAKE_CURRENT_SOURCE_DIR}/batch/page)
append_asset(INDEX_STYLE ${batch_assets}/index_page.css)
foreach(script index_data index_rows trend_series trend_plot index_trends index_page)
  append_asset(INDEX_SCRIPT ${batch_assets}/${script}.js)
endforeach()
configure_file(${batch_assets}/index_assets.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/index_assets.cpp @ONLY)
set(batch_GENERATED ${CMAKE_CURRENT_BINARY_DIR}/index_assets.cpp)
