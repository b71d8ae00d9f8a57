// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lib/identify/parameter_space.hpp"
#include "lib/identify/weak_form/weak_form.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Whether the inertia matrix is positive definite at random positions within `low` and `high`.
bool has_definite_inertia(const Chain& chain, const Eigen::VectorXd& low, const Eigen::VectorXd& high);

/// Returns why the parameters are infeasible, in words, or "": the inertia matrix must be positive definite
/// over the range of the joints, masses and rotor inertia not negative, and friction not clearly negative.
std::string infeasibility(const ParameterSpace& space, const Eigen::VectorXd& parameters,
                          const Eigen::MatrixXd& covariance, const Eigen::VectorXd& q_low,
                          const Eigen::VectorXd& q_high);

/// Returns the feasible parameters of the robot's link shapes nearest to the weighted system: masses and
/// friction positive, inertia that satisfies the triangle inequality (positive definite pseudo-inertia;
/// Wensing, Kim and Slotine 2018). Directions that the system does not determine stay near `robot`, scaled in
/// mass as a whole.
Eigen::VectorXd nearest_feasible(const ParameterSpace& space, const Robot& robot, const WeakSystem& system,
                                 const WeakFit& fit, const std::vector<bool>& wanted);

}  // namespace faultline
