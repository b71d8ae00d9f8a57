// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lib/golden/observation.hpp"
#include "lib/golden/tolerance.hpp"

namespace faultline {

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// One thing that is not as expected.
struct Difference {
  std::string channel;  ///< verdict, rows, event, onset_s, velocity_rms_2, dq2, m1 ...
  double time_s = std::numeric_limits<double>::quiet_NaN();  ///< in the log; NaN when it has no time
  std::string expected;                                      ///< as text; empty when nothing was expected
  std::string actual;
  double allowed = std::numeric_limits<double>::quiet_NaN();  ///< distance; NaN for what is no number

  /// Whether something else is said of the robot: the verdict, or which faults there are. The rest is how
  /// sure, when, and why.
  bool changes_verdict() const;
};

/// A line of a unified difference: the same on both sides, or one of them, or both in other words.
struct DiffLine {
  std::string expected;
  std::string actual;
  bool differs = false;
};

struct Comparison {
  std::vector<Difference> differences;
  std::vector<DiffLine> lines;

  bool same() const { return differences.empty(); }
  bool changes_verdict() const;
};

Comparison compare(const Observation& expected, const Observation& actual, const ToleranceChain& tolerances);
Comparison compare(const ObservedIdentification& expected, const ObservedIdentification& actual,
                   const ToleranceChain& tolerances);

/// Values of the same names; nothing where one side has none (values_of()).
Comparison compare(const std::vector<ParameterValue>& expected, const std::vector<ParameterValue>& actual,
                   const ToleranceChain& tolerances);

/// The earliest difference that has a time; else the first. Null when same.
const Difference* first_divergence(const Comparison& comparison);

/// Pairs events of the same kind and joint, the nearest onsets first, and compares their times and
/// confidence; what has no partner is missing or unexpected.
void compare_events(const std::vector<ObservedEvent>& expected, const std::vector<ObservedEvent>& actual,
                    const ToleranceChain& tolerances, Comparison& comparison);

}  // namespace faultline
