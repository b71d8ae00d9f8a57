// SPDX-License-Identifier: MIT
#pragma once

#include "lib/simulate/simulate.hpp"

namespace faultline {

/// The part of check_simulation() that nothing built from the spec checks by itself.
void check_numbers(const Robot& robot, const SimulationSpec& spec);

/// Control periods in a sample period. Throws Error(usage) when that is no whole number.
int control_periods_per_sample(const SimulationSpec& spec);

}  // namespace faultline
