// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/weak_form/weak_form.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Which parameters the robot file leaves to the logs; friction offsets are not among them, nor any friction
/// of joints that never move (`still`, from 1): at rest it may be anything up to stiction.
std::vector<bool> wanted_parameters(const ParameterSpace& space, const Robot& robot,
                                    const std::vector<int>& still);

/// The weak form, with friction offsets only where they clearly help; `wanted` becomes what was estimated.
WeakFit start_fit(const WeakWindows& windows, const Eigen::VectorXd& nominal, bool try_offsets,
                  const Robot& robot, std::vector<bool>& wanted);

}  // namespace faultline
