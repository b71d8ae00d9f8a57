// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/evidence/motion_model.hpp"
#include "lib/log/log.hpp"
#include "lib/reproduce/filter/log_noise.hpp"

namespace faultline {

/// A piece of a healthy log and how that log measures.
struct HealthyExcerpt {
  Log log;
  LogNoise noise{};
};

struct MatchOptions {
  bool held = false;      ///< the torque is known to be held between samples
  double period_s = 0.0;  ///< usual period of the logs
  int threads = 0;        ///< 0 = one a core; the result does not depend on it
};

/// Moves process noise, measurement noise, error of the clock and the pace of the slow states to where the
/// innovations of the healthy excerpts are likeliest: a coordinate search by shrinking factors. Stamps
/// that wobble are taken as steps of the period where that is likelier.
void match_noise(MotionModel& model, const std::vector<HealthyExcerpt>& logs, const MatchOptions& options);

}  // namespace faultline
