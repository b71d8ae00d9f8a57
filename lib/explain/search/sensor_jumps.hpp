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

std::vector<SensorJump> sensor_jumps(const LogFit& fit, int j);

/// Returns whether a false reading of size `b` takes back one of size `a`.
bool takes_back(double b, double a);
/// Returns when the first jump takes back a false reading, if one does.
std::optional<double> taken_back_s(const std::vector<SensorJump>& jumps, const FaultClaim& claim);

/// Returns the nats by which the jump of a false position (FaultKind::sensor_bias) explains the measurements
/// at its onset better than the motion by the velocity; 0 unless that is measured independently.
double jump_evidence(const LogFit& fit, const FaultClaim& claim);

/// Returns how many of the samples from `begin` to before `end` repeat the position before them.
int repeats(const UniformLog& log, int j, int begin, int end);

/// Returns whether repeated codes of a position are evidence: healthy logs repeat it for a few samples only.
bool repeats_are_rare(const BalanceModel& model, int j);

/// Returns when the position repeats one code for longer than healthy logs show: the longest of these spans,
/// then those in which the joint would have moved most at its speed before: a joint at rest slows down first.
std::vector<FaultSpan> repeated_codes(const LogFit& fit, int j);

}  // namespace faultline
