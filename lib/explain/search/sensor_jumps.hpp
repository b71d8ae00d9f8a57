// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/explain/log_fit.hpp"

namespace faultline {

/// A step of a measured position that no velocity explains.
struct SensorJump {
  double onset_s = 0.0;
  double size = 0.0;  ///< rad or m
};

std::vector<SensorJump> sensor_jumps(const LogFit& fit, int joint);

/// Nats by which the readings at the onset of a false position (FaultKind::sensor_bias) are explained better
/// by its jump than by the motion that the velocity shows; 0 where the velocity is not measured apart.
double jump_evidence(const LogFit& fit, const FaultClaim& claim);

/// Whether repeated codes of a position say anything: in healthy logs it repeats for a few samples only.
bool repeats_say_something(const BalanceModel& model, int joint);

/// A position that repeats one code for longer than healthy logs show.
struct RepeatedCode {
  double onset_s = 0.0;
  double end_s = kNeverEnds;
};

/// The longest of them, by their length.
std::vector<RepeatedCode> repeated_codes(const LogFit& fit, int joint);

}  // namespace faultline
