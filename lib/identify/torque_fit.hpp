// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/identify/gathered.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"
#include "lib/identify/weak_form/weak_form.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Result of the torque balance.
struct TorqueFit {
  WeakSystem system;
  WeakFit fit;
  std::vector<bool> wanted;
  std::vector<int> shift;  ///< by joint, samples
  /// Why the optimum is infeasible (the nearest feasible one was taken); else "".
  std::string why_infeasible;
  ParameterSpace space;  ///< the given one, with the chosen widths of bent friction
};

/// Fits the torque balance of the chosen windows and terms, and makes the result feasible. Parameters that
/// are not wanted stay at `nominal`.
TorqueFit fit_torque(const Gathered& gathered, const ModelChoice& choice, const Eigen::VectorXd& nominal,
                     const Robot& robot, const ParameterSpace& space);

}  // namespace faultline
