# SPDX-License-Identifier: MIT
# What `cmake --install` puts where. Components: `program` (what users run), `development` (find_package(faultline)).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(share ${CMAKE_INSTALL_DATADIR}/faultline)
install(TARGETS faultline RUNTIME COMPONENT program)
install(DIRECTORY ${PROJECT_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program FILES_MATCHING PATTERN *.1.gz)
install(FILES ${PROJECT_BINARY_DIR}/completion/faultline.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME faultline COMPONENT program)
install(FILES ${PROJECT_BINARY_DIR}/completion/faultline.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
        RENAME _faultline COMPONENT program)
install(FILES ${PROJECT_BINARY_DIR}/completion/faultline.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
        COMPONENT program)
install(DIRECTORY formats/presets sample_logs DESTINATION ${share} COMPONENT program)
# The README links to docs/.
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program PATTERN site EXCLUDE PATTERN build_site.sh EXCLUDE)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libfaultline-dev RENAME copyright COMPONENT development)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-faultline RENAME copyright COMPONENT python EXCLUDE_FROM_ALL)

# Headers stand in a folder of their own, so that "lib/log/log.hpp" finds itself and no other library.
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/faultline)
install(TARGETS ${FAULTLINE_LIBRARIES} faultline_formats EXPORT faultline
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/faultline COMPONENT development)
install(EXPORT faultline NAMESPACE faultline:: DESTINATION ${package} FILE faultlineTargets.cmake COMPONENT development)
install(DIRECTORY lib formats DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/faultline COMPONENT development
        FILES_MATCHING PATTERN *.hpp)
configure_package_config_file(apps/packaging/faultlineConfig.cmake.in ${PROJECT_BINARY_DIR}/faultlineConfig.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/faultlineConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/faultlineConfig.cmake ${PROJECT_BINARY_DIR}/faultlineConfigVersion.cmake
        DESTINATION ${package} COMPONENT development)
