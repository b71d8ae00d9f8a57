// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/ceres.h>

#include "lib/identify/shooting_evaluation.hpp"

namespace faultline {

/// Adds to `costs` what every excerpt and every prior costs, and the bounds of the parameters.
void add_costs(const ShootingProblem& problem, ShootingEvaluation& evaluation, ceres::Problem& costs);

}  // namespace faultline
