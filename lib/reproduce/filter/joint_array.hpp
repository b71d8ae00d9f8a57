// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "lib/robot/chain.hpp"

namespace faultline {

// One entry a joint, base to tip; entries beyond the robot's joints mean nothing.
using JointArray = std::array<double, kMaxJoints>;
using JointFlags = std::array<bool, kMaxJoints>;
using JointSquare = std::array<double, kMaxJoints * kMaxJoints>;  ///< row by row, n numbers each

/// Where the joints are and how fast they move.
struct MotionState {
  JointArray q;   ///< rad or m
  JointArray dq;  ///< rad/s or m/s
};

}  // namespace faultline
