// SPDX-License-Identifier: MIT
#pragma once

#include "lib/robot/chain.hpp"

namespace faultline {

/// Longest step at which the integration follows the friction of `chain` around zero velocity, s.
double stable_step(const Chain<double>& chain, const JointVector<double>& q,
                   const JointVector<double>& torque);

}  // namespace faultline
