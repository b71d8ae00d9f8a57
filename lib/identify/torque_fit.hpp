// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/identify/gathered.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"
#include "lib/identify/weak_form/weak_form.hpp"

namespace faultline {

/// Result of the torque balance.
struct TorqueFit {
  WeakSystem system;
  WeakFit fit;
  std::vector<bool> wanted;
  std::vector<int> shift;  ///< by joint, samples
  std::string
      why_infeasible;  ///< why the optimum is infeasible (the nearest feasible one was taken); else ""
};

/// Fits the torque balance of the chosen windows and terms, and makes the result feasible. Parameters that
/// are not wanted stay at `nominal`. Bent friction of `space` gets the widths chosen.
TorqueFit fit_torque(const Gathered& gathered, const ModelChoice& choice, const Eigen::VectorXd& nominal,
                     const Robot& robot, ParameterSpace& space);

}  // namespace faultline
