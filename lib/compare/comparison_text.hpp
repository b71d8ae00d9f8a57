// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/compare/compare_runs.hpp"

namespace faultline {

/// Returns the result in a sentence.
std::string verdict_of(const RunComparison& comparison);
/// Returns the unit of a signal. `turns`: whether each joint is revolute; joints beyond its end are.
const char* unit_of(const SignalDifference& signal, const std::vector<char>& turns);

/// Returns a text for a terminal; `turns` as for unit_of().
std::string to_text(const RunComparison& comparison, const std::vector<char>& turns);
/// Returns JSON, schema "faultline/comparison/1".
std::string to_json(const RunComparison& comparison, const std::vector<char>& turns);

}  // namespace faultline
