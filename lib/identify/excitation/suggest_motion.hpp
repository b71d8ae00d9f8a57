// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/simulate/simulate.hpp"

namespace faultline {

struct SuggestOptions {
  int candidates = 300;
  int threads = 0;  ///< 0: one per core; the result does not depend on it
};

/// Range, speed and torque of one joint in a suggested motion.
struct SuggestedJoint {
  AxisKind kind = AxisKind::revolute;
  double low = 0.0, high = 0.0;  ///< rad or m
  double fastest = 0.0;          ///< rad/s or m/s
  double torque = 0.0;           ///< largest torque that the identified robot needs for it, N m or N
  bool beyond_logs = false;      ///< the joint hardly moved in the logs, so it leaves their range or speed
};

/// A motion that determines the parameters better than the logs did.
struct SuggestedMotion {
  SimulationSpec simulation;
  std::uint64_t seed = 1;  ///< of its only run
  std::vector<SuggestedJoint> joints;
  double condition_of_logs = 0.0;  ///< infinite if some parameter is not identifiable
  double condition = 0.0;          ///< of this motion, in the same units
};

/// Returns the best of many random sums of harmonics (Swevers et al. 1997), by the condition number of base
/// parameters and friction together. Each joint stays within the positions and speeds of the logs; if it
/// hardly moved there, it moves by 1 rad at 1 rad/s (0.1 m, 0.1 m/s) about its middle position. Needs an
/// identification that comes from identify(), not from JSON.
SuggestedMotion suggest_motion(const Identification& identification, const SuggestOptions& options = {});

/// Returns the motion as a spec file for `faultline simulate` (docs/simulate.md). `robot_file` is the path of
/// the identified robot to write into it.
std::string suggestion_text(const SuggestedMotion& motion, const std::string& robot_file);

}  // namespace faultline
