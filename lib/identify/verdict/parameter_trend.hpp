// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

namespace faultline {

struct TorqueFit;

/// Estimate of a parameter from one log alone.
struct LogValue {
  int log = 0;  ///< from 0
  double value = 0.0;
  double std = 0.0;
  std::array<double, 2> ci95 = {0.0, 0.0};
};

/// Estimates of one parameter from log to log, and whether they change beyond chance.
struct ParameterTrend {
  std::string name, unit;
  std::vector<LogValue> by_log;  ///< logs that determine it alone, in their order
  double mean = 0.0;             ///< weighted by 1 / variance
  double chi_square = 0.0;       ///< of the hypothesis that all are the same
  double p_same = 1.0;           ///< probability of so much difference if they are the same
  double slope = 0.0;            ///< change from one log to the next
  double slope_std = 0.0;        ///< larger if logs scatter about the line more than their own std
  double p_level = 1.0;          ///< probability of so large a slope if there is none
  bool differs = false;          ///< they differ beyond chance, all tests together
  bool drifts = false;           ///< the slope differs from 0 beyond chance

  bool flagged() const { return differs || drifts; }
};

/// Probability, over all parameters together, that logs of an unchanged robot are flagged.
inline constexpr double kFalseFlags = 0.01;

/// Tests each parameter for homogeneity (chi-square) and for a slope in the order of logs, each at
/// kFalseFlags over the number of tests (Bonferroni). Returns the trends with all fields, of which the given
/// ones need only names and `by_log`.
std::vector<ParameterTrend> tested_trends(std::vector<ParameterTrend> trends);

/// Returns the estimates from each log alone of every fitted parameter, with the same windows and terms, and
/// whether they change from log to log. A log counts for a parameter only if its own motion determines it; a
/// parameter with fewer than three such logs is omitted. Empty with fewer logs.
///
/// A variance is the larger of two: from blocks of one log's residual (jackknife), which show model error
/// where it occurs, and from the residual's autocorrelation over all logs together, which a short log cannot
/// determine.
std::vector<ParameterTrend> parameter_trends(const TorqueFit& torque);

}  // namespace faultline
