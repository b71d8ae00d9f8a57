// SPDX-License-Identifier: MIT
#include "lib/balance/rest.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr int kFewestRows = 3;        // successive slow rows of a joint that rests
constexpr double kSlowShare = 0.01;   // of the greatest healthy speed
constexpr double kBeyondNoise = 3.0;  // times the noise of a measured velocity
constexpr double kAtLimit = 0.98;     // share of the limit of a drive from which on a row is at it
constexpr double kOutside = 0.05;     // share of the healthy range by which a joint must be outside
constexpr double kBounces_s = 0.30;   // time for which it bounces before it stays, at most
constexpr double kForce = 1e4;        // N m or N: standard deviation of the force of an end stop

/// Returns the speed by joint below which a joint rests: a small share of its greatest healthy speed, and
/// beyond the noise of its velocity.
Eigen::VectorXd speed_of_rest(const BalanceModel& model) {
  Eigen::VectorXd out = kSlowShare * model.top_speed;
  for (int j = 0; j < out.size(); ++j)
    if (model.setting.measures_velocity(j)) out[j] = std::max(out[j], kBeyondNoise * model.dq_noise[j]);
  return out;
}

/// Returns the first row of the stretch at which joint `j` (from 0) halts, even if it bounces before it
/// stays; the end of the stretch if it does not halt.
int halted_at(const BalanceRows& rows, const BalanceModel& model, int j, const StretchOutside& outside) {
  const double row_s = model.setting.row_s();
  const int before = std::max(1, static_cast<int>(std::lround(kHaltsIn_s / row_s)));
  const int after = std::max(2, static_cast<int>(std::lround(kStaysFor_s / row_s)));
  if (outside.end - outside.begin <= after) return outside.end;
  const double slow = std::max(
      3.0 * (model.dq_noise[j] > 0.0 && model.setting.measures_velocity(j) ? model.dq_noise[j] : 0.0),
      0.5 * model.setting.friction_width[j]);
  const int bounces = static_cast<int>(std::lround(kBounces_s / row_s));
  const auto speed = rows.dq.col(j);
  int first = -1;
  for (int k = outside.begin; k + after < outside.end; ++k) {
    if (speed[k] * outside.side >= slow) continue;
    const int from = std::max(0, k - before);
    const double fastest = (outside.side * speed.segment(from, k - from + 1)).maxCoeff();
    if (fastest <= kFastBeforeStop * model.top_speed[j]) continue;
    if (first < 0 || k - first > bounces) first = k;
    if (speed.segment(k + before, after - before).cwiseAbs().mean() < 2.0 * slow) return first;
  }
  return outside.end;
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

JointMask rows_at_limit(const BalanceRows& rows, const BalanceModel& model) {
  if (model.drive_limit.isZero(0.0)) return {};
  JointMask out = JointMask::Constant(rows.rows(), rows.joints(), false);
  for (int j = 0; j < rows.joints(); ++j)
    for (int k = 0; k < rows.rows() && model.drive_limit[j] > 0.0; ++k)
      if (std::abs(rows.torque(k, j)) > kAtLimit * model.drive_limit[j])
        for (int i = std::max(0, k - 1); i < std::min(rows.rows(), k + 2); ++i) out(i, j) = true;
  return out;
}

JointMask silent_balances(const BalanceRows& rows, const BalanceModel& model) {
  const JointMask sticks = sticking_rows(rows, model);
  JointMask out = rows_at_limit(rows, model);
  if (out.size() == 0) return sticks;
  if (sticks.size() > 0) out = out || sticks;
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

std::vector<StretchOutside> stretches_outside(const Eigen::VectorXd& q, double low, double high) {
  const double margin = kOutside * (high - low);
  const auto side = [&](int k) { return q[k] > high + margin ? 1.0 : q[k] < low - margin ? -1.0 : 0.0; };
  std::vector<StretchOutside> out;
  for (int begin = 0, end = 0; begin < static_cast<int>(q.size()); begin = end) {
    for (end = begin + 1; end < static_cast<int>(q.size()) && side(end) == side(begin);) ++end;
    if (side(begin) != 0.0) out.push_back({side(begin), begin, end});
  }
  return out;
}

Eigen::MatrixXd stop_std(const BalanceRows& rows, const BalanceModel& model) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(rows.rows(), rows.joints());
  const int reach = static_cast<int>(std::ceil(3.0 * model.setting.kernel_s / model.setting.row_s()));
  for (int j = 0; j < rows.joints(); ++j)
    for (const StretchOutside& each : stretches_outside(rows.q.col(j), model.q_low[j], model.q_high[j])) {
      const int at = halted_at(rows, model, j, each);
      if (at == each.end) continue;
      for (int i = std::max(0, at - reach); i < std::min(rows.rows(), each.end + reach); ++i)
        out(i, j) = kForce;
    }
  return out;
}

}  // namespace faultline
