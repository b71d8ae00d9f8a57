// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lib/compare/alignment.hpp"
#include "lib/compare/run_signals.hpp"

namespace faultline {

struct CompareOptions {
  AlignmentKind align = AlignmentKind::automatic;
  double false_alarms = 1e-3;  ///< chance that two runs that differ by noise alone are told apart
  int in_a_row = 3;            ///< samples beyond the threshold that make a divergence; one may be an outlier
};

/// How one signal differs between two runs: second minus first, at the samples of the first.
struct SignalDifference {
  std::string quantity;  ///< as in RunSignal
  int joint = 1;
  double rms = std::numeric_limits<double>::quiet_NaN();
  double largest = std::numeric_limits<double>::quiet_NaN();    ///< with its sign
  double largest_s = std::numeric_limits<double>::quiet_NaN();  ///< when, s from the start of the first run
  double noise = 0.0;      ///< standard deviation of the difference of both noises
  double threshold = 0.0;  ///< what the noise alone does not leave
  double beyond = 0.0;     ///< share of samples beyond what noise and interpolation explain
  double diverges_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: never leaves the noise
  bool judged = true;  ///< false: must differ, as torques when the moves last differently, or all but
                       ///< residuals of different motions
  double first_rms = std::numeric_limits<double>::quiet_NaN();   ///< of the first run's signal alone
  double second_rms = std::numeric_limits<double>::quiet_NaN();  ///< likewise
  std::vector<double> time, first, second, difference;           ///< NaN where a run has nothing
};

/// Two runs, signal by signal.
struct RunComparison {
  std::string first, second;  ///< names
  double first_length_s = 0.0, second_length_s = 0.0, first_period_s = 0.0, second_period_s = 0.0;
  RunAlignment alignment;
  double compared_s = 0.0;  ///< length of the part that both have
  double sigmas = 0.0;      ///< the threshold over the noise
  std::vector<SignalDifference> signals;
  std::vector<std::string> notes;  ///< what was not compared and why, a sentence each

  /// The earliest divergence; null when the runs are the same within noise.
  const SignalDifference* first_divergence() const;
  bool same() const { return alignment.same_motion && !first_divergence(); }
};

/// Throws Error(input) when the runs have different joints or do not overlap.
RunComparison compare_runs(RunSignals first, RunSignals second, const CompareOptions& options = {});

}  // namespace faultline
