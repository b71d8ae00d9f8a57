# SPDX-License-Identifier: MIT
# Puts the style and the script of a batch's index into a source file.
set(batch_assets ${CMAKE_CURRENT_SOURCE_DIR}/batch/page)
file(READ ${batch_assets}/index_page.css INDEX_STYLE)
file(READ ${batch_assets}/index_page.js INDEX_SCRIPT)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${batch_assets}/index_page.css
             ${batch_assets}/index_page.js)
configure_file(${batch_assets}/index_assets.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/index_assets.cpp @ONLY)
set(batch_GENERATED ${CMAKE_CURRENT_BINARY_DIR}/index_assets.cpp)
