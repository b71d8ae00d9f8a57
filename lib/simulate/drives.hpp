// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/random.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// What drives give beside what is commanded, and so logged, one each a joint; empty: nothing.
struct DriveSpec {
  std::vector<double> gain{};                ///< share by which more torque arrives: another torque constant
  std::vector<double> offset{};              ///< N m or N
  std::vector<double> roughness{};           ///< standard deviation of a torque that comes and goes, N m or N
  std::vector<double> roughness_memory_s{};  ///< its correlation time; 0.03 s where none is given
};

/// The torques that arrive at the joints. What comes and goes is an Ornstein-Uhlenbeck process.
class Drives {
 public:
  Drives(int joints, const DriveSpec& spec, Random random);

  /// `commanded` becomes what arrives, in the mean, over the next `length_s`.
  void act(double length_s, JointVector& commanded);

 private:
  double mean_roughness(int joint, double length_s);

  std::vector<double> gain_, offset_, roughness_, memory_s_;
  std::vector<double> rough_;  ///< now, N m or N
  Random random_;
};

}  // namespace faultline
