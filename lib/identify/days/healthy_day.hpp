// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/uniform_log.hpp"
#include "lib/balance/work_piece.hpp"

namespace faultline {

/// One healthy log while the robot is fitted.
struct HealthyDay {
  UniformLog log;
  BalanceRows rows{};
  std::vector<Eigen::MatrixXd> day_column{};  ///< columns of the effects of the day, by joint
  Eigen::MatrixXd tip{};                      ///< torque of 1 kg at the tip: rows x joints
  PiecePath path{};                           ///< of the work piece; empty without one
  Eigen::MatrixXd piece{};                    ///< torque of the work piece: rows x joints
  Eigen::VectorXd effect{};                   ///< of the day, see DayLayout
  Eigen::MatrixXd std{};                      ///< of the rows: rows x joints
};

/// What the rounds of the fit hand on: the model so far, its days, which columns of the robot are free.
struct DayDraft {
  BalanceModel model;
  std::vector<HealthyDay> days;
  std::vector<bool> used;
  std::vector<bool> refused{};  ///< columns that came out as no robot has them
};

/// Rows of all days as the setting of the model says.
DayDraft with_rows(DayDraft draft);
/// Columns of the effects of the days, and the torque of 1 kg at the tip, by the parameters of the model.
DayDraft with_day_columns(DayDraft draft);

/// Torque that robot, work piece and effects of the day leave unexplained: rows x joints.
Eigen::MatrixXd left_over(const HealthyDay& day, const Eigen::VectorXd& theta);
/// Torque of the effects of the day: rows x joints.
Eigen::MatrixXd effect_torque(const HealthyDay& day);

/// Rows on each side of a change of the work piece that its kernel reaches.
int reach_of_change(const RowSetting& setting);
/// Rows of a day that lie so near a change that they say little; empty without a work piece.
std::vector<bool> rows_near_change(const HealthyDay& day, const BalanceModel& model);

}  // namespace faultline
