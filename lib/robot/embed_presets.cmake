# SPDX-License-Identifier: MIT
# Puts the presets of formats/presets into a source file.
file(GLOB preset_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/formats/presets/*.toml)
list(SORT preset_files)
set(PRESET_ENTRIES "")
foreach(file IN LISTS preset_files)
  file(READ ${file} text)
  get_filename_component(name ${file} NAME_WE)
  string(APPEND PRESET_ENTRIES "      {\"${name}\", R\"faultline(${text})faultline\"},\n")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
endforeach()
configure_file(${CMAKE_CURRENT_SOURCE_DIR}/robot/log_presets.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/log_presets.cpp @ONLY)
set(robot_GENERATED ${CMAKE_CURRENT_BINARY_DIR}/log_presets.cpp)
