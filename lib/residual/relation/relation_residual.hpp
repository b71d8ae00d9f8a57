// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "lib/residual/relation/signal_relation.hpp"

namespace faultline {

/// The latest rows of a relation's inputs, as the terms that its weights multiply.
class LagLine {
 public:
  /// `relation` outlives this.
  explicit LagLine(const SignalRelation& relation);

  /// Takes row `row`. Returns false if too few rows precede it without a gap, or an input is missing. For
  /// tracking, whose inputs are smooth, a few lost rows are interpolated.
  bool take(const Log& log, int row);
  /// Valid after take() returned true; as many as SignalRelation::weights_needed().
  const std::vector<double>& terms() const { return terms_; }

 private:
  void push(std::size_t input, double value);
  double followed(double input, const Log& log, int row, double dt);

  const SignalRelation& relation_;
  std::size_t reach_;  ///< rows before the present one that the terms need
  double followed_ = std::numeric_limits<double>::quiet_NaN();  ///< the first input under the rate limit
  std::vector<double> before_;                                  ///< by input, the latest row first
  std::vector<double> terms_;
  int rows_ = 0;  ///< number of rows since the last gap
  double last_s_ = -std::numeric_limits<double>::infinity();
};

/// A row of a relation's residual.
struct RelationSample {
  double time = 0.0;       ///< s
  double reference = 0.0;  ///< the first input
  double predicted = 0.0;
  /// The part of the prediction that differs between days: of a drive, its part by speed; of tracking, its
  /// change since the row before, as by a reference that is logged a row earlier or later.
  double by_speed = 0.0;
  double residual = 0.0;  ///< target minus predicted, in the target's unit
};

/// The residual of a relation along a log, row by row; its state crosses segment borders.
class RelationResidual {
 public:
  /// `relation` outlives this.
  explicit RelationResidual(const SignalRelation& relation) : relation_(relation), line_(relation) {}

  /// Returns the sample of a row; nullopt if it cannot be judged: a value is missing, or an input is outside
  /// the learned range or was shortly before. If a torque is predicted beyond the range of the healthy logs,
  /// the residual is 0 from that range to the prediction, as of a drive at its limit, and if both are
  /// beyond. `log` has the signals (has_signals()).
  std::optional<RelationSample> take(const Log& log, int row);
  /// For how long inputs were outside the learned range, s.
  double beyond_s() const { return beyond_s_; }

 private:
  double residual(double target, double predicted) const;
  bool terms_are_known() const;

  const SignalRelation& relation_;
  LagLine line_;
  double last_predicted_ = std::numeric_limits<double>::quiet_NaN();
  double beyond_s_ = 0.0;
  double unknown_s_ = -std::numeric_limits<double>::infinity();  ///< last row outside the learned range
};

/// Lengths over which residuals are averaged, s: shorter ones show each transient of a current loop.
inline constexpr double kRelationWindows_s[] = {0.1, 0.2, 0.4, 0.8, 1.6};

/// Means of a series of samples over its latest windows.
class WindowedMeans {
 public:
  /// `rows`: length of each window, at least 1, the shortest first.
  explicit WindowedMeans(std::vector<int> rows);

  /// Adds a sample. A pause of more than a fifth of a second interrupts the series: all windows begin anew.
  void add(double value, double time_s);
  void restart();
  /// Number of windows that are full; these are the shortest ones.
  int full() const;
  double mean(int window) const { return sum_[window] / rows_[window]; }
  int rows(int window) const { return rows_[window]; }

 private:
  std::vector<int> rows_;
  std::vector<double> ring_;  ///< the latest values of the longest window
  std::vector<double> sum_;   ///< by window
  std::size_t next_ = 0;      ///< index of the next value in ring_
  long long count_ = 0;
  double last_s_ = -std::numeric_limits<double>::infinity();
};

/// Returns the rows of each window at that period, at least one each.
std::vector<int> window_rows(std::span<const double> windows_s, double period_s);

}  // namespace faultline
