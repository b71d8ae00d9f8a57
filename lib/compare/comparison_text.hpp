// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/compare/compare_runs.hpp"

namespace faultline {

/// The answer in a sentence.
std::string verdict_of(const RunComparison& comparison);
/// Unit of a quantity at a joint that turns or slides.
const char* unit_of(const std::string& quantity, bool turns);

/// For a terminal. `turns`: of each joint, whether it turns; joints beyond it turn.
std::string to_text(const RunComparison& comparison, const std::vector<char>& turns);
/// Schema "faultline/comparison/1".
std::string to_json(const RunComparison& comparison, const std::vector<char>& turns);

}  // namespace faultline
