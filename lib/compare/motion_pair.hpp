// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/compare/run_signals.hpp"

namespace faultline {

/// Motions that are no further apart, rms in shares of their spread, agree.
inline constexpr double kSameMotion = 0.05;
/// Of the shorter run, what has to lie beside the other one.
inline constexpr double kLeastOverlap = 0.5;
/// A squared distance that counts no further.
inline constexpr double kOutlier = 0.01;

/// Both motions on the scale of the first: 1 is the standard deviation of a joint. Refers to the runs.
class MotionPair {
 public:
  MotionPair(const RunSignals& first, const RunSignals& second);

  /// Of all joints, scaled; NaN where a run has none.
  std::vector<double> first_at(double t) const { return at(first_, t); }
  std::vector<double> second_at(double t) const { return at(second_, t); }

  /// How well times fit: what is between the motions at t of the first run and at times(t) of the second.
  struct Fit {
    double left_rms = 0.0;  ///< distances beyond 1 count as 1; NaN without common time
    double agreeing = 0.0;  ///< share of the time in which they agree
  };
  template <typename Times>
  Fit fit(Times times, double step) const {
    Tally tally;
    for (double t = 0.0; t <= first_.length_s; t += step)
      tally.add(squared(first_at(t), second_at(times(t))));
    return tally.fit();
  }

  /// Mean of squared distances that count up to kOutlier; infinite with too little overlap.
  double cost(double shift, double step) const;
  /// Time to add to `at` in the second run so that it is where the first is at `t`, by the speed there; NaN
  /// where it is slower than `slow`.
  double correction(double t, double at, double slow) const;
  double rms_speed() const;
  /// Of the motions, scaled, all joints together.
  double noise() const;
  /// At which motions are looked at first, s.
  double coarse_step() const;

 private:
  struct Tally {
    double squares = 0.0, agree = 0.0, count = 0.0;
    void add(double squared_distance);
    Fit fit() const;
  };

  static double squared(const std::vector<double>& a, const std::vector<double>& b);
  std::vector<double> at(const RunSignals& run, double t) const;

  const RunSignals &first_, &second_;
  std::vector<double> scale_;
};

}  // namespace faultline
