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
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0 is one a core; the result does not depend on it
};

/// How far and how fast one joint moves in a suggested motion.
struct SuggestedJoint {
  AxisKind kind = AxisKind::revolute;
  double low = 0.0, high = 0.0;  ///< rad or m
  double fastest = 0.0;          ///< rad/s or m/s
  double torque = 0.0;           ///< the most that the identified robot needs for it, N m or N
  bool beyond_logs = false;      ///< the logs showed too little of this joint to stay within them
};

/// A motion that tells the parameters better than the logs did.
struct SuggestedMotion {
  SimulationSpec simulation;
  std::uint64_t seed = 1;  ///< of its only run
  std::vector<SuggestedJoint> joints;
  double condition_of_logs = 0.0;  ///< infinite when they do not tell some parameter at all
  double condition = 0.0;          ///< of this motion, in the same units
};

/// The best of many random sums of harmonics (Swevers et al. 1997), by the condition number of base
/// parameters and friction together. Each joint stays within the positions and speeds that the logs showed,
/// or, where they showed next to nothing, moves by 1 rad at 1 rad/s (0.1 m, 0.1 m/s) about where it was.
/// Needs an identification that comes from identify(), not from JSON.
SuggestedMotion suggest_motion(const Identification& identification, const SuggestOptions& options = {});

/// The motion as a spec file for `faultline simulate` (docs/simulate.md). `robot_file` is the identified
/// robot as the spec is to name it.
std::string suggestion_text(const SuggestedMotion& motion, const std::string& robot_file);

}  // namespace faultline
