// SPDX-License-Identifier: MIT
#include "lib/identify/days/healthy_day.hpp"

#include <cmath>

#include "lib/balance/rest.hpp"

namespace faultline {

DayDraft with_rows(DayDraft draft) {
  const BalanceModel& m = draft.model;
  for (HealthyDay& day : draft.days) {
    day.rows = balance_rows(day.log, m.setting, m.rigid, m.theta);
    day.rows.silent = silent_balances(day.rows, m);
    if (day.piece.size() == 0) day.piece.setZero(day.rows.rows(), m.joints());
  }
  return draft;
}

DayDraft with_day_columns(DayDraft draft) {
  const BalanceModel& m = draft.model;
  for (HealthyDay& day : draft.days) {
    day.day_column = day_columns(day.rows, m);
    if (day.effect.size() == 0) day.effect.setZero(day_layout(m).count());
    day.tip = payload_torque(day.rows, m.payload, m.joints() - 1);
  }
  return draft;
}

Eigen::MatrixXd effect_torque(const HealthyDay& day) {
  Eigen::MatrixXd out(day.rows.rows(), day.rows.joints());
  for (int j = 0; j < out.cols(); ++j) out.col(j) = day.day_column[j] * day.effect;
  return out;
}

Eigen::MatrixXd left_over(const HealthyDay& day, const Eigen::VectorXd& theta) {
  return day.rows.torque - torque_of(day.rows, theta) - day.piece - effect_torque(day);
}

std::vector<bool> rows_near_change(const HealthyDay& day, const BalanceModel& model) {
  constexpr double kReach = 3.0;  // standard deviations of the kernel
  if (model.piece_kg <= 0.0) return {};
  return near_change(day.path,
                     static_cast<int>(std::ceil(kReach * model.setting.kernel_s / model.setting.row_s())));
}

}  // namespace faultline
