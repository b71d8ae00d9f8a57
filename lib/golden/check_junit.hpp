// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/golden/check.hpp"

namespace faultline {

/// JUnit XML: a test case for each log and for the identification. A mismatch is a failure whose message is
/// the first divergence, a damaged golden file an error.
std::string render_check_junit(const GoldenCheck& check, const std::string& suite);

}  // namespace faultline
