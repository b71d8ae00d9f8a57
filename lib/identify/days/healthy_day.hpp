// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/uniform_log.hpp"
#include "lib/balance/work_piece.hpp"

namespace faultline {

/// One healthy log during the fit of the robot.
struct HealthyDay {
  UniformLog log;
  BalanceRows rows{};
  std::vector<Eigen::MatrixXd> day_column{};  ///< columns of the effects of the day, by joint
  Eigen::MatrixXd tip{};                      ///< torque of 1 kg at the tip: rows x joints
  PiecePath path{};                           ///< of the work piece; empty without one
  Eigen::MatrixXd piece{};                    ///< torque of the work piece: rows x joints
  Eigen::VectorXd effect{};                   ///< of the day, see DayLayout
  Eigen::MatrixXd std{};                      ///< standard deviation of the rows: rows x joints
};

/// State that the rounds of the fit hand on: model, days and free columns of the robot.
struct DayDraft {
  BalanceModel model;
  std::vector<HealthyDay> days;
  std::vector<bool> used;
  std::vector<bool> refused{};  ///< columns whose estimate was infeasible (a negative rotor inertia)
};

/// Computes the rows of all days by the setting of the model.
DayDraft with_rows(DayDraft draft);
/// Computes the columns of the day effects, and the torque of 1 kg at the tip, from the model's parameters.
DayDraft with_day_columns(DayDraft draft);

/// Returns the torque residual after robot, work piece and effects of the day: rows x joints.
Eigen::MatrixXd left_over(const HealthyDay& day, const Eigen::VectorXd& theta);
/// Returns the torque of the effects of the day: rows x joints.
Eigen::MatrixXd effect_torque(const HealthyDay& day);

/// Returns the number of rows on each side of a work piece change that its kernel reaches.
int reach_of_change(const RowSetting& setting);
/// Returns, for each row, whether it is within that reach of a change; empty without a work piece.
std::vector<bool> rows_near_change(const HealthyDay& day, const BalanceModel& model);

}  // namespace faultline
