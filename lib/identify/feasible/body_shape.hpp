// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/robot/robot.hpp"

namespace faultline {

/// A symmetric matrix, linear in some of the unknowns, that must be positive definite.
struct DefiniteBlock {
  int first = 0;                       ///< index of its first unknown; its unknowns follow each other
  std::vector<Eigen::MatrixXd> basis;  ///< value of the block for one unit of each unknown
  Eigen::VectorXd nominal;             ///< its unknowns for the robot as given, with which it is definite

  int unknowns() const { return static_cast<int>(basis.size()); }
  Eigen::MatrixXd value(const Eigen::VectorXd& own_unknowns) const;
};

/// The feasible bodies and rotors of a robot with these link shapes: `numbers` times the unknowns are the
/// links' inertial numbers, then the rotors' inertia (11 n), and every block is positive definite. The block
/// of a rod is [inertia, first moment; first moment, mass], of a point its mass, of a general link its
/// pseudo-inertia (Wensing, Kim and Slotine 2018), of a rotor its inertia.
struct BodyShapes {
  Eigen::MatrixXd numbers;  ///< 11 n x unknowns
  std::vector<DefiniteBlock> blocks;

  int unknowns() const { return static_cast<int>(numbers.cols()); }
};

BodyShapes body_shapes(const Robot& robot);

/// Returns the block of one number, unknown `first`, that must be positive.
DefiniteBlock positive_number(int first, double nominal);

}  // namespace faultline
