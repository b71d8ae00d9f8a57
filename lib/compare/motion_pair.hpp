// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "lib/compare/run_signals.hpp"

namespace faultline {

/// Largest rms distance of motions that agree, in standard deviations of the motion.
inline constexpr double kSameMotion = 0.05;
/// Least share of the shorter run that must overlap the other run.
inline constexpr double kLeastOverlap = 0.5;
/// Bound of a squared distance in cost(), so that outliers do not decide.
inline constexpr double kOutlier = 0.01;

/// Both motions on the scale of the first: 1 is the standard deviation of a joint. Refers to the runs.
class MotionPair {
 public:
  MotionPair(const RunSignals& first, const RunSignals& second);

  /// Scaled positions of all joints; NaN if a run has none at `t`.
  std::vector<double> first_at(double t) const { return at(first_, t); }
  std::vector<double> second_at(double t) const { return at(second_, t); }

  /// Fit of assigned times: distance between the motions at t of the first run and at times(t) of the second.
  struct Fit {
    double left_rms = 0.0;  ///< distances beyond 1 count as 1; NaN without common time
    double agreeing = 0.0;  ///< share of the time in which the motions agree
  };
  Fit fit(const std::function<double(double)>& times, double step) const;

  /// Returns the mean of squared distances, each bounded by kOutlier; infinite with too little overlap.
  double cost(double shift, double step) const;
  /// Returns the time to add to `at` in the second run to reach the first run's position at `t`, by the speed
  /// at `at`; NaN if that is below `slow`.
  double correction(double t, double at, double slow) const;
  double rms_speed() const;
  /// Returns the noise of the scaled motions, over all joints.
  double noise() const;
  /// Returns the step of the first search, s.
  double coarse_step() const;

 private:
  static double squared(const std::vector<double>& a, const std::vector<double>& b);
  std::vector<double> at(const RunSignals& run, double t) const;

  const RunSignals &first_, &second_;
  std::vector<double> scale_;
};

/// Equidistant samples of several signals: [sample][signal].
using MotionSamples = std::vector<std::vector<double>>;

/// Returns for each sample of `first` the place among those of `second` (fractional, never decreasing) that
/// minimises the sum of squared distances: dynamic time warping. First samples and last samples correspond.
std::vector<double> warped_places(const MotionSamples& first, const MotionSamples& second);

}  // namespace faultline
