// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
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

/// Multiples of a period. For periods of whole microseconds, returns the doubles nearest to the decimal
/// times, so that a log has 3.953 and not 3.9530000000000003.
class Clock {
 public:
  explicit Clock(double period_s) : period_s_(period_s) {
    const double micro = period_s * 1e6;
    if (std::round(micro) >= 1.0 && std::abs(micro - std::round(micro)) < 1e-6) micro_ = std::round(micro);
  }
  double at(std::int64_t tick) const {
    const auto k = static_cast<double>(tick);
    return micro_ > 0.0 ? k * micro_ / 1e6 : k * period_s_;
  }

 private:
  double period_s_;
  double micro_ = 0.0;
};

}  // namespace faultline
