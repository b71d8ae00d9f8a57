// SPDX-License-Identifier: MIT
#pragma once

#include "lib/diagnose/diagnosis.hpp"
#include "lib/report/fact_table.hpp"

namespace faultline {

/// What the log tells of the robot's condition, a row each; no rows where it tells nothing.
FactTable condition_table(const Diagnosis& diagnosis);

}  // namespace faultline
