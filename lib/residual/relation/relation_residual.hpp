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
  /// What no day repeats exactly: of a drive, what of the prediction its speed says; of a motion, what a
  /// reference that is logged a row sooner or later changes.
  double by_speed = 0.0;
  double residual = 0.0;  ///< target less predicted, in the target's unit
};

/// The residual of a relation along a log, row by row; its state crosses segment borders.
class RelationResidual {
 public:
  /// `relation` outlives this.
  explicit RelationResidual(const SignalRelation& relation) : relation_(relation), line_(relation) {}

  /// nullopt where the row cannot be judged: something is missing, or moves as nothing that was learned,
  /// and for a while after that.
  /// Where a torque is predicted beyond what healthy logs reached, one between their most and the prediction
  /// is as good as predicted: a drive in its limit; where both are beyond, the residual is 0. `log` has the
  /// signals (has_signals()).
  std::optional<RelationSample> take(const Log& log, int row);
  /// For how long rows were beyond all that was learned, s.
  double beyond_s() const { return beyond_s_; }

 private:
  double residual(double target, double predicted) const;
  bool terms_are_known() const;

  const SignalRelation& relation_;
  LagLine line_;
  double last_predicted_ = std::numeric_limits<double>::quiet_NaN();
  double beyond_s_ = 0.0;
  double unknown_s_ = -std::numeric_limits<double>::infinity();  ///< last row beyond what was learned
};

}  // namespace faultline
