// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lib/identify/parameter_space.hpp"
#include "lib/identify/weak_form/weak_form.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// What is wrong with parameters that no body can have, in words; empty when nothing is: the inertia matrix
/// is positive definite over the range of the joints, masses and rotors are positive, friction is not clearly
/// negative.
std::string infeasibility(const ParameterSpace& space, const Eigen::VectorXd& parameters,
                          const Eigen::MatrixXd& covariance, const Eigen::VectorXd& q_low,
                          const Eigen::VectorXd& q_high);

/// The parameters nearest to the weighted system that bodies of the robot's shapes can have: masses and
/// friction positive, inertia that satisfies the triangle inequality (positive definite pseudo-inertia;
/// Wensing, Kim and Slotine 2018). What the system does not tell stays near `robot`, made heavier or lighter
/// as a whole.
Eigen::VectorXd nearest_feasible(const ParameterSpace& space, const Robot& robot, const WeakSystem& system,
                                 const WeakFit& fit, const std::vector<bool>& wanted);

}  // namespace faultline
