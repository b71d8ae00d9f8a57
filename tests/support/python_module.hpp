// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/skip_unless_installed.hpp"

// For sources with the definitions FAULTLINE_PYTHON_DIR and FAULTLINE_PYTHON_LEFT_OUT of
// tests/CMakeLists.txt.
namespace faultline {

/// The compiled part of the Python module in the build folder; empty where it is not built.
inline std::string compiled_python_module() {
  const std::filesystem::path package = std::filesystem::path(FAULTLINE_PYTHON_DIR) / "faultline";
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(package, missing))
    if (entry.path().filename().string().starts_with("_faultline.") && entry.path().extension() == ".so")
      return entry.path().string();
  return "";
}

}  // namespace faultline

/// Skips a test where the module was left out on purpose, as by -DFAULTLINE_PYTHON=OFF; SKIP_UNLESS_INSTALLED
/// where its packages are missing.
#define SKIP_UNLESS_PYTHON_MODULE()                                                                  \
  do {                                                                                               \
    if (FAULTLINE_PYTHON_LEFT_OUT) GTEST_SKIP() << "the Python module was left out";                 \
    SKIP_UNLESS_INSTALLED(!::faultline::compiled_python_module().empty(),                            \
                          "the Python module is not built: pybind11-dev or python3-dev is missing"); \
  } while (false)
