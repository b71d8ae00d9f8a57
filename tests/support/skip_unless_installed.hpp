// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

namespace faultline {

/// Whether tests/run.sh runs the tests, which has just installed every package of `apps/install.sh --tests`.
inline bool all_packages_are_installed() { return std::getenv("FAULTLINE_PACKAGES_INSTALLED") != nullptr; }

}  // namespace faultline

/// Skips a test where something that `bash apps/install.sh --tests` installs is missing; under tests/run.sh
/// the test fails instead.
#define SKIP_UNLESS_INSTALLED(found, reason)                                    \
  do {                                                                          \
    if (!(found)) {                                                             \
      if (::faultline::all_packages_are_installed())                            \
        FAIL() << (reason) << "; tests/run.sh should have installed that";      \
      GTEST_SKIP() << (reason) << ": bash apps/install.sh --tests installs it"; \
    }                                                                           \
  } while (false)
