// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/log/log.hpp"
#include "lib/residual/residual_generator.hpp"

namespace faultline {

/// Marks a missing value or time.
inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// Sample periods without a sample from which on there is a gap.
inline constexpr double kGapPeriods = 4.0;

struct ValueBetween {
  double value = 0.0;  ///< NaN outside the signal, in a gap and beside a missing sample
  double error = 0.0;  ///< estimated error: the change by one more sample
};

/// Interpolates by the cubic through four samples around `at`, but not between samples over `gap_s` apart.
ValueBetween value_between(const std::vector<double>& time, const std::vector<double>& values, double at,
                           double gap_s);

/// Returns the standard deviation of a signal's noise from its third differences, which slow motion hardly
/// affects: robust (a median), at least that of its quantisation step, 0 for fewer than four samples.
double noise_of(const std::vector<double>& values);

/// One quantity of one joint over a whole run.
struct RunSignal {
  std::string quantity;  ///< position, velocity, torque, residual
  Joint joint = 1_joint;
  std::vector<double> time;  ///< s, from the first row of the run
  std::vector<double> values;
};

struct RunSignals {
  std::string name;
  double start_s = 0.0, length_s = 0.0;
  double period_s = 0.0;           ///< median
  std::vector<RunSignal> signals;  ///< those that the log has, by quantity, then joint
  std::vector<RunSignal> motion;   ///< signals for the alignment: the references, or else the positions
  bool by_reference = false;       ///< whether `motion` is the references

  /// Returns null if the run does not have the signal.
  const RunSignal* find(const std::string& quantity, Joint joint) const;
};

/// Returns the signals of a whole log; with a generator also its normalised velocity residuals (1 as in
/// healthy logs). Throws Error(input) for a log of fewer than eight rows.
RunSignals run_signals(const std::string& name, const Log& log, const ResidualGenerator* generator = nullptr);

/// Returns the run for alignment by positions, as needed if the other run has no references.
RunSignals by_positions(RunSignals run);

}  // namespace faultline
