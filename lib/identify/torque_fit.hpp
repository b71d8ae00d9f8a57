// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/identify/gathered.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"
#include "lib/identify/weak_form/weak_form.hpp"

namespace faultline {

/// What the torque balance says.
struct TorqueFit {
  WeakSystem system;
  WeakFit fit;
  std::vector<bool> wanted;
  std::vector<int> shift;   ///< by joint, samples
  std::string not_a_robot;  ///< why what fits best is none, so that the nearest one was taken; else ""
};

/// The fit of the torque balance of the chosen windows and terms, brought to a robot that can be. Parameters
/// that are not wanted stay at `nominal`. Bent friction of `space` gets the widths chosen.
TorqueFit fit_torque(const Gathered& gathered, const ModelChoice& choice, const Eigen::VectorXd& nominal,
                     const Robot& robot, ParameterSpace& space);

}  // namespace faultline
