// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/compare/compare_runs.hpp"

namespace faultline {

/// JUnit XML for continuous-integration servers: the second run is a suite, each signal a test case that
/// fails where the runs diverge and is skipped if it is not judged; other motions fail a case "motion".
std::string comparison_junit(const RunComparison& comparison, const std::vector<char>& turns);

}  // namespace faultline
