// SPDX-License-Identifier: MIT
#include "lib/balance/rest.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr int kFewestRows = 3;        // successive slow rows of a joint that rests
constexpr double kSlowShare = 0.01;   // of the greatest healthy speed
constexpr double kBeyondNoise = 3.0;  // times the noise of a measured velocity

/// Returns the speed by joint below which a joint rests: a small share of its greatest healthy speed, and
/// beyond the noise of its velocity.
Eigen::VectorXd speed_of_rest(const BalanceModel& model) {
  Eigen::VectorXd out = kSlowShare * model.top_speed;
  for (int j = 0; j < out.size(); ++j)
    if (model.setting.measures_velocity(j)) out[j] = std::max(out[j], kBeyondNoise * model.dq_noise[j]);
  return out;
}

}  // namespace

JointMask resting_rows(const BalanceRows& rows, const Eigen::VectorXd& slow) {
  JointMask out = JointMask::Constant(rows.rows(), rows.joints(), false);
  for (int j = 0; j < rows.joints(); ++j)
    for (int k = 0; k < rows.rows();) {
      int end = k;
      while (end < rows.rows() && std::abs(rows.dq(end, j)) < slow[j]) ++end;
      if (end - k >= kFewestRows)
        for (int i = std::max(0, k - 1); i < std::min(rows.rows(), end + 1); ++i) out(i, j) = true;
      k = end + 1;
    }
  return out;
}

JointMask sticking_rows(const BalanceRows& rows, const BalanceModel& model) {
  if (model.stiction.isZero(0.0)) return {};
  JointMask out = resting_rows(rows, speed_of_rest(model));
  for (int j = 0; j < rows.joints(); ++j)
    if (model.stiction[j] == 0.0) out.col(j).setConstant(false);
  return out;
}

JointMask rows_within_stiction(const BalanceRows& rows, const BalanceModel& model,
                               const Eigen::MatrixXd& residual) {
  JointMask out = sticking_rows(rows, model);
  for (int j = 0; j < out.cols(); ++j)
    for (int k = 0; k < rows.rows(); ++k)
      out(k, j) = out(k, j) && std::abs(residual(k, j)) < model.stiction[j];
  return out;
}

BalanceRows without_balances(BalanceRows rows, const JointMask& mask) {
  for (int j = 0; j < mask.cols(); ++j)
    for (int k = 0; k < rows.rows(); ++k) {
      if (!mask(k, j)) continue;
      rows.torque(k, j) = 0.0;
      rows.column[j].row(k).setZero();
    }
  return rows;
}

}  // namespace faultline
