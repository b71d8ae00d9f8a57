// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/log_fit.hpp"

namespace faultline {

inline constexpr int kRowsOfChange = 6;  ///< rows that a change of the work piece reaches on either side

/// Returns the nats of a row of joint `j` (from 0) with a torque of its own, of usual size for the joint.
double free_row_price(const LogFit& fit, int row, int j);

/// Returns the residual without the work piece, by its path before effects of the day were estimated.
Stacked torque_without_piece(const LogFit& fit);

/// Rows as which the noise of the healthy logs counts in the estimate of the noise of a log.
inline constexpr double kRowsOfHealthyLogs = 30.0;

/// The moment at which healthy robot and day cease to explain a log.
struct Change {
  int last_row = 0;       ///< last one that they explain
  double onset_s = 0.0;   ///< of the row after it
  Eigen::VectorXd day{};  ///< effects, estimated from the rows up to the last one
};

/// Returns the moment after which the rows of some joint, explained as those before it, cost more than a few
/// nats each.
Change first_change(const LogFit& fit);

/// Free form of a fault: healthy robot and day explain the log up to a moment; after it, each row has a
/// torque of its own, of usual size, on the joints that need one.
struct FreeForm {
  double onset_s = 0.0;
  double end_s = kNeverEnds;   ///< time from which the healthy robot explains the rows again
  Eigen::VectorXd row_cost{};  ///< nats of each row: of its residual, or of a torque of its own
  Stacked left{};              ///< whitened residuals with the effects of the day before the onset
};

/// Estimates up to which moment the healthy robot explains the rows, and from when on again, if each row of
/// every joint in between costs a few nats. The onset is later than first_change() if a single joint changes
/// slightly: a fault of no known kind needs more evidence than the exclusion of rows from the noise of the
/// log. The effects of the day are those of the rows before.
FreeForm free_form(const LogFit& fit);

}  // namespace faultline
