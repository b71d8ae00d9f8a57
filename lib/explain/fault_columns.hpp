// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/explain/fault_claim.hpp"

namespace faultline {

/// A value of every row and joint of a log, joint after joint: joint * rows + row.
using Stacked = Eigen::VectorXd;
/// Columns of such values.
using StackedColumns = Eigen::MatrixXd;
/// Rows that count for nothing, stacked.
using StackedMask = std::vector<bool>;

/// Columns of a hypothesis with the prior variance of their sizes.
struct FaultColumns {
  StackedColumns column;  ///< (joints * rows) x sizes
  Eigen::VectorXd variance;
  bool grow = false;  ///< the sizes are those of each second since the onset

  int sizes() const { return static_cast<int>(column.cols()); }
};

/// Columns of a fault that is linear, as if it lasted from the first row to the last.
struct LinearFault {
  FaultKind kind = FaultKind::none;
  int joint = 0;  ///< from 1
  FaultColumns columns;
  std::vector<Eigen::VectorXd> starts;  ///< sizes to search the path of a work piece from
};

/// Torque loss where it shows, offset of the torque, friction and friction that creeps of each joint, payload
/// of each link whose payload shows.
std::vector<LinearFault> linear_faults(const BalanceRows& rows, const BalanceModel& model);

/// The linear fault that a claim is of; null where its kind has none.
const LinearFault* linear_of(const std::vector<LinearFault>& faults, const FaultClaim& claim);

/// The columns of a collision: an unknown force that pushes each joint, the same from onset to end, then one
/// on each joint that rises and falls in between (half a sine).
FaultColumns force_columns(const BalanceRows& rows, const RowSetting& setting, double onset_s, double end_s);

/// The columns switched on at the onset and off at the end (equation (9) of docs/how-it-works.md), smoothed
/// as the rows are; those that grow begin with nothing.
FaultColumns between(FaultColumns columns, const BalanceRows& rows, const RowSetting& setting, double onset_s,
                     double end_s);

/// Step at `time_s`, smoothed as the rows are: by row, 0 before and 1 after.
Eigen::VectorXd soft_step(const BalanceRows& rows, const RowSetting& setting, double time_s);

/// Rows that say nothing while a fault lasts: those of a locked joint, those of all joints that the motion of
/// a joint with a stuck encoder reaches, all of an unknown fault.
StackedMask silent_rows(const BalanceRows& rows, const BalanceModel& model, const FaultClaim& claim);

inline constexpr double kChangeDoubt_rows = 0.6;  ///< standard deviation of the time of a change

/// Rows x joints from a stacked value, and back.
Eigen::MatrixXd unstacked(const Stacked& values, int joints);
Stacked stacked(const Eigen::MatrixXd& values);

/// Rows that the begin or the end of a fault reaches: 1 there, 0 elsewhere.
Eigen::VectorXd fault_edges(const BalanceRows& rows, const RowSetting& setting, const FaultClaim& claim);

/// Shares of a fault's torque that its columns lack of its true form, where that is not kFormShare: of a
/// blow, and at the begin or end of any fault.
inline constexpr double kShareOfBlow = 0.5, kEdgeShare = 0.5;

/// That of a kind, away from begin and end.
double form_share(FaultKind kind);

/// By row, the share of a fault's torque that its columns lack of its true form: a lost torque has no other
/// form, a blow any, and a begin or end may take some time.
Eigen::VectorXd form_shares(const BalanceRows& rows, const RowSetting& setting, const FaultClaim& claim);

/// What the joint of a false reading would read without it; the claim has its size.
JointReading without_false_reading(const UniformLog& log, const FaultClaim& claim);
/// The log without all false readings among the claims.
UniformLog without_false_readings(UniformLog log, const std::vector<FaultClaim>& claims);

}  // namespace faultline
