// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/balance/one_step/one_step_model.hpp"

namespace faultline {

/// The robot's own numbers by least squares of momentum differences between neighbouring samples: a start,
/// biased by noise and by the coarse rate. Each joint counts by its usual torque.
Eigen::VectorXd coarse_start(const std::vector<UniformLog>& logs, const OneStepModel& model);

}  // namespace faultline
