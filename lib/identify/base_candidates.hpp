// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/identify/parameter_space.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// A way the links' inertial numbers may change.
struct BaseCandidate {
  BaseParameter parameter;
  Eigen::VectorXd direction;  ///< 11 n: the links' numbers, then the rotors' inertia
};

/// Whether the robot's base parameters are a, b, c and m3 of the SCARA.
bool is_scara(const Robot& robot);

/// Every change the robot's link shapes allow, the ones to be kept first: those whose torques depend on
/// the torques of earlier ones are no base parameters.
std::vector<BaseCandidate> base_candidates(const Robot& robot);

}  // namespace faultline
