// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lib/compare/alignment.hpp"
#include "lib/compare/run_signals.hpp"
#include "lib/core/joint.hpp"

namespace faultline {

/// Difference of one signal between two runs: second minus first, at the samples of the first.
struct SignalDifference {
  std::string quantity;  ///< as in RunSignal
  Joint joint = 1_joint;
  double rms = std::numeric_limits<double>::quiet_NaN();
  double largest = std::numeric_limits<double>::quiet_NaN();    ///< signed
  double largest_s = std::numeric_limits<double>::quiet_NaN();  ///< its time, s from the first run's start
  double noise = 0.0;      ///< standard deviation of the difference of both signals' noise
  double threshold = 0.0;  ///< least difference that noise alone does not explain
  double beyond = 0.0;     ///< share of samples beyond noise and interpolation error
  double diverges_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: does not diverge
  bool judged = true;  ///< false: must differ, as torques of moves of different duration, or all signals but
                       ///< residuals of different motions
  double first_rms = std::numeric_limits<double>::quiet_NaN();   ///< of the first run's signal
  double second_rms = std::numeric_limits<double>::quiet_NaN();  ///< of the second run's signal
  std::vector<double> time, first, second, difference;           ///< NaN if a run has no value
};

/// The differences of two runs in all signals.
struct RunComparison {
  std::string first, second;  ///< names
  double first_length_s = 0.0, second_length_s = 0.0, first_period_s = 0.0, second_period_s = 0.0;
  RunAlignment alignment;
  double compared_s = 0.0;  ///< length of the part that both runs have
  double sigmas = 0.0;      ///< threshold divided by noise
  std::vector<SignalDifference> signals;
  std::vector<std::string> notes;  ///< what was not compared and why, a sentence each

  /// Returns the earliest divergence; null if the runs are the same within noise.
  const SignalDifference* first_divergence() const;
  bool same() const { return alignment.same_motion && !first_divergence(); }
};

/// Throws Error(input) if the runs have different joints or do not overlap.
RunComparison compare_runs(RunSignals first, RunSignals second,
                           AlignmentKind align = AlignmentKind::automatic);

/// Returns the result in a sentence.
std::string verdict_of(const RunComparison& comparison);
/// Returns the unit of a signal. `turns`: whether each joint is revolute; joints beyond its end are.
const char* unit_of(const SignalDifference& signal, const std::vector<char>& turns);

/// Returns a text for a terminal; `turns` as for unit_of().
std::string to_text(const RunComparison& comparison, const std::vector<char>& turns);
/// Returns JSON, schema "faultline/comparison/1".
std::string to_json(const RunComparison& comparison, const std::vector<char>& turns);

}  // namespace faultline
