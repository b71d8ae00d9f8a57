# SPDX-License-Identifier: MIT
# `cpack -G DEB` in the build folder: faultline (the program), libfaultline-dev and, where the Python module is built,
# python3-faultline. apps/packaging/release.sh calls it.
set(CPACK_PACKAGE_NAME faultline)
set(CPACK_PACKAGE_CONTACT "the faultline authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "fault diagnosis of SCARA robots from recorded joint logs")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME faultline)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS bash-completion)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "Learns a model of a robot from logs of healthy runs and determines from the log
of a bad run which fault it is, at which joint and from what time.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libfaultline-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libceres-dev, libsuitesparse-dev, libfmt-dev, nlohmann-json3-dev, libtomlplusplus-dev, libtinyxml2-dev, libsqlite3-dev, libssl-dev, libxxhash-dev, zlib1g-dev, libzstd-dev, liblz4-dev, libbz2-dev, libhdf5-dev, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers and static libraries; find_package(faultline) in CMake.")

if(TARGET faultline_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next_minor "${FAULTLINE_PYTHON_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-faultline)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${FAULTLINE_PYTHON_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-onnx, python3-matplotlib")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "What the program does, for Python: on files, NumPy arrays and pandas frames.")
endif()
include(CPack)
