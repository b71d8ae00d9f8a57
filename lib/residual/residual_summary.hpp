// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "lib/residual/residuals.hpp"

namespace faultline {

/// The residual of one joint over some time: measured minus regenerated fault-free motion (the one-step
/// prediction of the MLP), normalised by its healthy rms, so that about 1 is healthy. NaN when no residual
/// could be computed.
struct JointResidual {
  int joint = 0;  ///< from 1
  double velocity_rms = std::numeric_limits<double>::quiet_NaN();
  double velocity_peak = std::numeric_limits<double>::quiet_NaN();  ///< largest magnitude
  double velocity_peak_s = std::numeric_limits<double>::quiet_NaN();
  double position_rms = std::numeric_limits<double>::quiet_NaN();
  double position_peak = std::numeric_limits<double>::quiet_NaN();
  double mean_ratio =
      std::numeric_limits<double>::quiet_NaN();  ///< of Residuals::ratio: about -1 for a free joint
  std::int64_t count = 0;                        ///< predictions that count: those without missing numbers
};

/// Sums residuals of a log, or of an interval of it, as they stream by.
class ResidualSummary {
 public:
  /// Counts predictions with from_s <= time <= to_s.
  explicit ResidualSummary(double from_s = -std::numeric_limits<double>::infinity(),
                           double to_s = std::numeric_limits<double>::infinity())
      : from_s_(from_s), to_s_(to_s) {}

  void add(const Residuals& residuals);
  /// Returns the summary so far, one entry a joint.
  std::vector<JointResidual> joints() const;
  double from_s() const { return from_s_; }
  double to_s() const { return to_s_; }

 private:
  struct Sums {
    std::int64_t count = 0;
    double velocity2 = 0.0, position2 = 0.0, ratio = 0.0;
    double velocity_peak = 0.0, velocity_peak_s = 0.0, position_peak = 0.0;
  };

  double from_s_, to_s_;
  std::vector<Sums> sums_;
};

}  // namespace faultline
