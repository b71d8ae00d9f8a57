// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lib/evidence/evidence_options.hpp"
#include "lib/evidence/size_priors.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/normal_range.hpp"

namespace faultline {

/// What identification says of the robot, as far as the filters need it.
struct IdentifiedMotion {
  Chain<double> chain;
  double torque_phi = 0.0;
  bool torque_is_held = false;  ///< known, not estimated: nothing unseen happens between two samples
  std::vector<double> q_std;    ///< measurement noise, one a joint
  std::vector<double> dq_std;
};

struct LearnMotionOptions {
  int excerpt_rows = 12000;  ///< of all logs together, for matching the noise
  // Floors that keep a model of perfect logs from trusting itself too much: the smallest error of a parameter
  // and of the shape of friction.
  double least_torque_share = 0.003;
  double least_rest_share = 0.05;
  double safety = 1.25;  ///< the matched process noise is taken this much larger: other days are worse
  SizePriorOptions priors{};
  /// How far healthy days may differ; without it the robot is exactly the identified one at all times.
  std::optional<NormalRange> normal = NormalRange{};
  int threads = 0;  ///< 0 = one a core; the result does not depend on it
};

/// A motion model whose process noise is matched to the innovations of the healthy logs by maximum
/// likelihood, with ranges, repeated codes and size priors read from the same logs. Throws Error(input) when
/// the logs hold too few rows.
MotionModel learn_motion_model(std::span<LogSource* const> logs, const IdentifiedMotion& identified,
                               const LearnMotionOptions& options);

/// The largest statistics that a healthy log reaches.
struct HealthyExtremes {
  double trigger = 0.0;
  std::vector<double> ratio;  ///< most nats that each hypothesis explained of it

  double largest_ratio() const;
};

struct CalibratedThresholds {
  EvidenceOptions options;
  std::vector<HealthyExtremes> logs;  ///< a log each, before any process noise was made larger
};

/// Runs the bank over the healthy logs themselves and raises trigger and threshold above what they reach, up
/// to a limit. Where they pass the limit, the process noise does not cover what the model misses and is made
/// larger, a few times at most. The result does not depend on `threads` (0 = one a core).
CalibratedThresholds calibrate_thresholds(std::span<LogSource* const> logs, MotionModel& model,
                                          const std::vector<Hypothesis>& hypotheses,
                                          const EvidenceOptions& start, int threads = 0);

}  // namespace faultline
