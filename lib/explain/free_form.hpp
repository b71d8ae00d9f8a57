// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/evidence_course.hpp"
#include "lib/explain/log_fit.hpp"

namespace faultline {

inline constexpr int kRowsOfChange = 6;  ///< on each side of a change of the work piece: kernel and filter

/// Torque that the robot leaves unexplained without the work piece, whose path is that before anything was
/// known of the day.
Stacked torque_without_piece(const LogFit& fit);

/// Rows that the noise of the healthy logs counts for in the noise of a log.
inline constexpr double kRowsOfHealthyLogs = 30.0;

/// Where the healthy robot and the day cease to explain a log.
struct Change {
  int last_row = 0;       ///< that they explain
  double onset_s = 0.0;   ///< of the row after it
  Eigen::VectorXd day{};  ///< effects, as the rows up to the last one show them
};

/// The moment from which on the rows of some joint cost more, as those before it explain them, than a few
/// nats each.
Change first_change(const LogFit& fit);

/// A change of any form: the log is explained up to a moment, and what follows is a torque of the usual size
/// that every row has of its own, on the joints that need one.
struct FreeForm {
  double onset_s = 0.0;
  double end_s = kNeverEnds;   ///< from which the healthy robot explains the rows again
  Eigen::VectorXd row_cost{};  ///< nats of each row: what it is off by, or what a torque of its own costs
  Eigen::VectorXd day{};       ///< effects, as the rows before the onset show them
  Stacked left{};  ///< whitened rows left over, with the effects that the rows before the onset show
};

/// The moment up to which rows are explained, and from when on they are again, where each row of every joint
/// in between costs a few nats. It is later than first_change() where one joint alone changes a little: a
/// fault of no kind needs more evidence than rows that are not counted as the noise of the log. The effects
/// of the day are those of the rows before.
FreeForm free_form(const LogFit& fit);

/// How what the rows before a change cannot explain grows from it on.
EvidenceCourse evidence_course(const LogFit& fit, const FreeForm& change);

}  // namespace faultline
