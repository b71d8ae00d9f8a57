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
