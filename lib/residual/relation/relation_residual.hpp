// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "lib/residual/relation/lag_line.hpp"

namespace faultline {

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

}  // namespace faultline
