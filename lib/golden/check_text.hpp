// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/golden/check.hpp"

namespace faultline {

/// A table of all items, then of each that differs its first divergence and a unified difference.
std::string render_check_text(const GoldenCheck& check, bool color = false);

/// The unified difference of one item: lines of - expected and + actual among those that agree.
std::string unified_difference(const CheckedItem& item, const GoldenCheck& check, bool color = false);

/// "first divergence at 3.204 s: dq2 is 0.412, expected 0.398 (allowed 0.003)"; empty when nothing differs.
std::string divergence_text(const CheckedItem& item);

/// JUnit XML: a test case for each log and for the identification. A mismatch is a failure whose message is
/// the first divergence, a damaged golden file an error.
std::string render_check_junit(const GoldenCheck& check, const std::string& suite);

}  // namespace faultline
