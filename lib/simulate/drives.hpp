// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/random.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// Torque of the drives beyond the commanded, logged one; one number for each joint; empty: none.
struct DriveSpec {
  std::vector<double> gain{};                ///< relative excess of the torque: another torque constant
  std::vector<double> offset{};              ///< N m or N
  std::vector<double> roughness{};           ///< standard deviation of a random torque, N m or N
  std::vector<double> roughness_memory_s{};  ///< correlation time of the random torque; empty: 0.03 s
  std::vector<double> limit{};               ///< largest acting torque, N m or N; empty: no limit
};

/// The torques that act on the joints. The random torque is an Ornstein-Uhlenbeck process.
class Drives {
 public:
  Drives(int joints, const DriveSpec& spec, Random random);

  /// Replaces the `commanded` torque by the mean acting torque over the next `length_s`.
  void act(double length_s, JointVector& commanded);

 private:
  double mean_roughness(int j, double length_s);

  std::vector<double> gain_, offset_, roughness_, memory_s_, limit_;
  std::vector<double> rough_;  ///< random torque at present, N m or N
  Random random_;
};

}  // namespace faultline
