// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/robot/robot.hpp"

namespace faultline {

/// Unbounded numbers that stand for every set of bodies and rotors a robot of these link shapes can have, and
/// for no other: a rod has a mass, a centre and an inertia about it; a point a mass; a general link the
/// log-Cholesky factor of its pseudo-inertia; a rotor its inertia.
class BodyNumbers {
 public:
  explicit BodyNumbers(const Robot& robot);

  int count() const { return static_cast<int>(start_.size()); }
  /// Those of the robot's own links.
  const Eigen::VectorXd& start() const { return start_; }
  /// How far from the start each may well be: a factor of 20 in masses and inertias, a metre.
  const Eigen::VectorXd& doubt() const { return doubt_; }
  /// The links' inertial numbers, then the rotors' inertia: 11 n.
  Eigen::VectorXd numbers(const Eigen::VectorXd& x) const;

 private:
  void add(double start, double doubt);
  void add_link(const Robot& robot, int i);

  std::vector<LinkShape> shapes_;
  std::vector<Eigen::Vector3d> along_;
  Eigen::VectorXd start_, doubt_;
};

}  // namespace faultline
