// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/explain/log_fit.hpp"

namespace faultline {

/// A step of a measured position that the motion of the joint does not explain.
struct SensorJump {
  double onset_s = 0.0;
  double size = 0.0;  ///< rad or m
};

std::vector<SensorJump> sensor_jumps(const LogFit& fit, int joint);

/// Returns the nats by which the jump of a false position (FaultKind::sensor_bias) explains the measurements
/// at its onset better than the motion by the velocity; 0 unless that is measured independently.
double jump_evidence(const LogFit& fit, const FaultClaim& claim);

/// Returns whether repeated codes of a position are evidence: healthy logs repeat it for a few samples only.
bool repeats_are_rare(const BalanceModel& model, int joint);

/// A position that repeats one code for longer than healthy logs show.
struct RepeatedCode {
  double onset_s = 0.0;
  double end_s = kNeverEnds;
};

/// Returns the longest of them, then those in which the joint would have moved most at its speed before: a
/// joint at rest slows down first.
std::vector<RepeatedCode> repeated_codes(const LogFit& fit, int joint);

}  // namespace faultline
