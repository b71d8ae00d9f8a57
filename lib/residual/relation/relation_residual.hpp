// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "lib/residual/relation/lag_line.hpp"

namespace faultline {

/// A row of a relation's residual.
struct RelationSample {
  double time = 0.0;  ///< s
  double predicted = 0.0;
  double by_speed = 0.0;  ///< of a drive: what of that its speed says, which no day repeats exactly
  double residual = 0.0;  ///< target less predicted, in the target's unit
};

/// The residual of a relation along a log, row by row; its state crosses segment borders.
class RelationResidual {
 public:
  /// `relation` outlives this.
  explicit RelationResidual(const SignalRelation& relation) : relation_(relation), line_(relation) {}

  /// nullopt where the row cannot be judged: something is missing, or moves as nothing that was learned,
  /// and for a while after that.
  /// Where a torque and its prediction are both beyond what healthy logs reached, as of a drive in its limit,
  /// the residual is 0. `log` has the signals (has_signals()).
  std::optional<RelationSample> take(const Log& log, int row);

 private:
  bool terms_are_known() const;

  const SignalRelation& relation_;
  LagLine line_;
  double unknown_s_ = -std::numeric_limits<double>::infinity();  ///< last row beyond what was learned
};

}  // namespace faultline
