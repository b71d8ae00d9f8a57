// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/robot/robot.hpp"

namespace faultline {

/// A symmetric matrix, linear in some of the unknowns, that must be positive definite.
struct DefiniteBlock {
  int first = 0;                       ///< of the unknowns it is made of; they follow each other
  std::vector<Eigen::MatrixXd> basis;  ///< what a unit of each adds to it
  Eigen::VectorXd nominal;             ///< the unknowns of the robot as it stands, with which it is definite

  int unknowns() const { return static_cast<int>(basis.size()); }
  Eigen::MatrixXd value(const Eigen::VectorXd& own_unknowns) const;
};

/// The bodies and rotors that a robot of these link shapes can have: `numbers` times the unknowns are the
/// links' inertial numbers, then the rotors' inertia (11 n), and every block is positive definite. The block
/// of a rod is [inertia, first moment; first moment, mass], of a point its mass, of a general link its
/// pseudo-inertia (Wensing, Kim and Slotine 2018), of a rotor its inertia.
struct BodyShapes {
  Eigen::MatrixXd numbers;  ///< 11 n x unknowns
  std::vector<DefiniteBlock> blocks;

  int unknowns() const { return static_cast<int>(numbers.cols()); }
};

BodyShapes body_shapes(const Robot& robot);

/// One number that must be positive, at unknown `first`.
DefiniteBlock positive_number(int first, double nominal);

}  // namespace faultline
