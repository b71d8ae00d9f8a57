// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/random.hpp"
#include "lib/log/log.hpp"

namespace faultline {

enum class RecordedVelocity {
  measured,    ///< what the controller gets
  difference,  ///< of the position read and the one a row before, over the sample period
};

/// What a log makes of what was; by default it is the truth, row by row.
struct RecordingSpec {
  /// s, standard deviation of the time stamps about the instants of the readings, which stay steady.
  double jitter_s = 0.0;
  double stamp_resolution_s = 0.0;  ///< stamps are multiples of it; 0: exact
  double lost = 0.0;                ///< share of the rows between first and last that are missing, at random
  int torque_late_rows = 0;         ///< the torque of a row is that of so many rows before
  std::vector<double> torque_resolution{};  ///< N m or N, one each a joint; 0 or empty: exact
  RecordedVelocity velocity = RecordedVelocity::measured;
};

/// Throws Error(usage) naming the key when no log of so many joints and that period can be so.
void check_recording(int joints, double sample_period_s, const RecordingSpec& spec);

/// The log that is recorded of `exact`, which has the row k at k sample periods. Stamps ascend and are not
/// below 0; the first row keeps its measured velocity, and the torque of the first row stands for the one
/// before the log.
Log recorded(Log exact, const RecordingSpec& spec, double sample_period_s, Random random);

}  // namespace faultline
