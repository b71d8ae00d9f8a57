// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/core/joint.hpp"
#include "lib/explain/fault_claim.hpp"

namespace faultline {

/// A value of every row and joint of a log, joint after joint: joint * rows + row (joint from 0).
using Stacked = Eigen::VectorXd;
/// Columns of such values.
using StackedColumns = Eigen::MatrixXd;
/// Rows without weight, stacked.
using StackedMask = std::vector<bool>;

/// Columns of a hypothesis with the prior variance of their sizes.
struct FaultColumns {
  StackedColumns column;  ///< (joints * rows) x sizes
  Eigen::VectorXd variance;
  bool grow = false;  ///< the sizes are growth per second since the onset

  int sizes() const { return static_cast<int>(column.cols()); }
};

/// Columns of a linear fault that lasts from the first row to the last.
struct LinearFault {
  FaultKind kind = FaultKind::none;
  Joint joint{};
  FaultColumns columns;
  std::vector<Eigen::VectorXd> starts;  ///< sizes from which the path of a work piece is searched
  /// Of a changed load: kg that the link carries, of which it cannot lose more.
  double carried_kg = 0.0;
};

/// Returns the linear faults: torque loss unless the torque is measured behind the drive, offset of the
/// torque, friction and friction that creeps of each joint, payload of each link whose payload shows.
std::vector<LinearFault> linear_faults(const BalanceRows& rows, const BalanceModel& model);

/// Returns the linear fault of a claim; null if its kind has none.
const LinearFault* linear_of(const std::vector<LinearFault>& faults, const FaultClaim& claim);

/// Returns the columns of a collision: an unknown force on each joint from onset to end, of each form of
/// kMeanOfForceForm in turn.
FaultColumns force_columns(const BalanceRows& rows, const RowSetting& setting, double onset_s, double end_s);

/// Switches columns on at the onset and off at the end (equation (9) of docs/how-it-works.md), smoothed as
/// the rows are; those that grow begin at zero.
FaultColumns between(FaultColumns columns, const BalanceRows& rows, const RowSetting& setting, double onset_s,
                     double end_s);

/// Returns a step at `time_s`, smoothed as the rows are: by row, 0 before and 1 after.
Eigen::VectorXd soft_step(const BalanceRows& rows, const RowSetting& setting, double time_s);

/// Returns the silent rows of a fault: those of a locked joint, those of a joint with a stuck encoder and of
/// the joints that its motion reaches, all rows of an unknown fault.
StackedMask silent_rows(const BalanceRows& rows, const BalanceModel& model, const FaultClaim& claim);

inline constexpr double kChangeStd_rows = 0.6;  ///< standard deviation of the time of a work piece's change

/// Converts a stacked value to rows x joints, and back.
Eigen::MatrixXd unstacked(const Stacked& values, int joints);
Stacked stacked(const Eigen::MatrixXd& values);

/// Returns by row 1 if begin or end of a fault reaches it, else 0.
Eigen::VectorXd fault_edges(const BalanceRows& rows, const RowSetting& setting, const FaultClaim& claim);

/// Form errors (shares of a fault's torque that its columns lack) that replace kFormShare: of a collision,
/// and at begin and end of any fault.
inline constexpr double kShareOfBlow = 0.5, kEdgeShare = 0.5;

/// Returns the form error of a kind, away from begin and end.
double form_share(FaultKind kind);

/// Returns the form error by row, as a share of the fault's torque: that of its kind, and at least kEdgeShare
/// at begin and end, which may take some time.
Eigen::VectorXd form_shares(const BalanceRows& rows, const RowSetting& setting, const FaultClaim& claim);

/// Returns the measurements of the joint without the false reading of the claim, which has a size.
MeasuredMotion without_position_error(const UniformLog& log, const FaultClaim& claim);
/// Returns the log without all false readings among the claims.
UniformLog without_position_errors(UniformLog log, const std::vector<FaultClaim>& claims);

}  // namespace faultline
