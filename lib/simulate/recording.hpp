// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/random.hpp"
#include "lib/log/log.hpp"

namespace faultline {

enum class RecordedVelocity {
  measured,    ///< the measured velocity that the controller gets
  difference,  ///< backward difference of the measured positions over the sample period
};

/// How the log deviates from the simulated signals; by default not at all.
struct RecordingSpec {
  /// Standard deviation (s) of the time stamps about the measurement times, which stay equidistant.
  double jitter_s = 0.0;
  double stamp_resolution_s = 0.0;  ///< stamps are multiples of it; 0: exact
  double lost = 0.0;                ///< share of the rows between first and last that are lost at random
  int torque_late_rows = 0;         ///< a row has the torque of the row this number of rows before
  std::vector<double> torque_resolution{};  ///< N m or N, one number for each joint; 0 or empty: exact
  RecordedVelocity velocity = RecordedVelocity::measured;
  double velocity_filter_s = 0.0;  ///< time constant of a low pass of first order on that velocity; 0: none
};

/// Throws Error(usage) naming the key if `spec` does not fit so many joints or that sample period.
void check_recording(int joints, double sample_period_s, const RecordingSpec& spec);

/// Returns the log that is recorded of `exact`, whose row k is at k sample periods. Stamps ascend and are not
/// below 0; the first row keeps its measured velocity, and the torque of the first row also stands for rows
/// before the log.
Log recorded(Log exact, const RecordingSpec& spec, double sample_period_s, Random random);

}  // namespace faultline
