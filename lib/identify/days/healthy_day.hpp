// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/uniform_log.hpp"
#include "lib/balance/work_piece.hpp"
#include "lib/identify/extra/extra_term.hpp"

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
  std::vector<ExtraTerm> extra{};  ///< of the robot
};

/// Computes the rows of all days by the setting of the model.
DayDraft with_rows(DayDraft draft);
/// Computes the columns of the day effects, and the torque of 1 kg at the tip, from the model's parameters.
DayDraft with_day_columns(DayDraft draft);

/// Returns the torque residual after robot, work piece and effects of the day: rows x joints.
Eigen::MatrixXd left_over(const HealthyDay& day, const Eigen::VectorXd& theta);
/// Returns the torque of the effects of the day: rows x joints.
Eigen::MatrixXd effect_torque(const HealthyDay& day);

/// Returns, for each row, whether the kernel reaches from it to a change of the work piece; empty without
/// one.
std::vector<bool> rows_near_change(const HealthyDay& day, const BalanceModel& model);

/// Adds the mass of a work piece that comes and goes, and sets the robot's mass to that of the rows without
/// it; unchanged if no such mass stands out in the days. The mass at the tip is estimated from short
/// stretches of rows, and these masses are split into two groups.
DayDraft with_first_piece(DayDraft draft);

/// Estimates the path of the work piece in each day from the residual of robot and day effects, and its mass
/// from these paths. `is_rough`: the robot is still inaccurate, so only a step of most of that mass counts.
DayDraft with_piece_paths(DayDraft draft, bool is_rough);

/// Refines the friction width of each joint on the residual after effects of the days and work piece.
DayDraft with_refined_widths(DayDraft draft);

/// Keeps the columns of those gear springs that explain their joint clearly better than a rigid gear, with
/// friction behind the spring. The column alone also fits residual friction when a light joint reverses.
DayDraft with_chosen_springs(DayDraft draft);

/// Sets the compliance of the gear springs from their columns: friction acts behind the spring.
BalanceModel with_compliance(BalanceModel model);

/// Adds torques that repeat with a position, if they explain a large part of the residual.
DayDraft with_ripples(DayDraft draft);

/// Returns the column of an extra term of the robot in the rows; none for ripples and springs, for which the
/// fit of the days looks itself.
std::optional<int> column_of(const ExtraTerm& term, const ColumnLayout& layout);

/// Leaves out rotors that act apart from the links and whose estimate is negative, and extra terms whose
/// estimate is impossible (is_possible()), such as load friction that takes more than the gear carries.
DayDraft without_impossible_terms(DayDraft draft);

}  // namespace faultline
