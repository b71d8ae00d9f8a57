// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/balance/one_step/one_step_model.hpp"

namespace faultline {

/// The robot's own numbers (MotionLayout::learned()) to start a fit from: those of momentum differences
/// between neighbouring samples or the identified ones, whichever predict the readings of these logs better.
Eigen::VectorXd coarse_start(const std::vector<UniformLog>& logs, const OneStepModel& model,
                             const Eigen::VectorXd& identified_base,
                             const std::vector<Friction<double>>& identified_friction);

}  // namespace faultline
