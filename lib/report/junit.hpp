// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

/// JUnit XML for continuous-integration servers: the log is a suite, each joint a test case that fails with
/// the faults found on it; faults of no joint fail a case "robot"; an inconclusive log is one skipped case.
std::string render_junit(const Diagnosis& diagnosis);

}  // namespace faultline
