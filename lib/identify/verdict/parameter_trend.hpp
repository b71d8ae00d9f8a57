// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

namespace faultline {

/// What one log alone says of a parameter.
struct LogValue {
  int log = 0;  ///< from 0
  double value = 0.0;
  double std = 0.0;
  std::array<double, 2> ci95 = {0.0, 0.0};
};

/// One parameter from log to log, and whether it changes beyond chance.
struct ParameterTrend {
  std::string name, unit;
  std::vector<LogValue> by_log;  ///< those logs that tell it alone, in their order
  double mean = 0.0;             ///< weighted by 1 / variance
  double chi_square = 0.0;       ///< of all being the same
  double p_same = 1.0;           ///< chance of so much difference when they are
  double slope = 0.0;            ///< change from one log to the next
  double slope_std = 0.0;        ///< larger where logs scatter about the line more than their own std says
  double p_level = 1.0;          ///< chance of so large a slope when there is none
  bool differs = false;          ///< beyond chance, all tests together
  bool drifts = false;           ///< so does its slope

  bool flagged() const { return differs || drifts; }
};

/// Chance, over all parameters together, that logs of an unchanged robot are flagged.
inline constexpr double kFalseFlags = 0.01;

/// Tests each parameter for homogeneity (chi-square) and for a slope in the order of logs, each at
/// kFalseFlags over the number of tests (Bonferroni). Fills in all but names and `by_log`.
void test_trends(std::vector<ParameterTrend>& trends);

}  // namespace faultline
