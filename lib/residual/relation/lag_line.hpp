// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "lib/residual/relation/signal_relation.hpp"

namespace faultline {

/// The latest rows of a relation's inputs, as the terms that its weights multiply.
class LagLine {
 public:
  explicit LagLine(const SignalRelation& relation);

  /// Takes row `row`. Returns false if too few rows precede it without a gap, or an input is missing. For
  /// tracking, whose inputs are smooth, a few lost rows are interpolated.
  bool take(const Log& log, int row);
  /// Valid after take() returned true; as many as SignalRelation::weights_needed().
  const std::vector<double>& terms() const { return terms_; }

 private:
  void push(std::size_t input, double value);
  double followed(double input, const Log& log, int row, double dt);

  std::vector<Quantity> inputs_;
  Quantity target_;
  bool bridges_;
  int joint_, lags_, stride_;
  double period_s_, rate_limit_;
  double followed_ = std::numeric_limits<double>::quiet_NaN();  ///< the first input under rate_limit_
  std::vector<double> before_;                                  ///< by input, the latest row first
  std::vector<double> terms_;
  int rows_ = 0;  ///< number of rows since the last gap
  double last_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace faultline
