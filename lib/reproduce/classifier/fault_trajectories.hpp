// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>

#include "lib/reproduce/protocol/protocol.hpp"

namespace faultline {

inline constexpr int kFaultClasses = 4;  ///< in the order of the outputs: free joint 1, 2, 3, and no fault
inline constexpr int kPatternsPerTrajectory = 10;
inline constexpr int kTable1Trajectories = 90;

/// The output (0 to 3) that a trajectory of the paper's table 1 belongs to: of 1-20 a free joint 1, 21-40
/// joint 2, 41-75 joint 3, 76-90 no fault. `index` counts from 0 to 89.
int table_1_class(int index);
/// What each class is: a free-swinging joint, or none.
FaultLabel fault_of_class(int output);
/// Share of each class in table 1.
Eigen::Vector4d table_1_prior();

/// Patterns of single samples with their truth.
struct FaultPatterns {
  std::array<Transitions, kFaultClasses> of_class;

  int count() const;
};

/// How patterns are made. The default is the paper's training set.
struct FaultTrajectories {
  int count = kTable1Trajectories;
  double sigma = 0.0;       ///< measurement noise, half ranges
  double torque_phi = 0.0;  ///< as in TransitionShape
};

/// Trajectories of ten samples in the order and mix of table 1, the fault there from the start. Use
/// classifier_training or classifier_test.
FaultPatterns fault_patterns(const Experiment& experiment, const FaultTrajectories& trajectories,
                             SeedUse use);

}  // namespace faultline
