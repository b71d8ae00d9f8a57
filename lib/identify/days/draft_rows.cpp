// SPDX-License-Identifier: MIT
#include "lib/identify/days/draft_rows.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"
#include "lib/log/difference_velocity.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kMostDecay = 5.0;   // samples^-1: crossover of the fusion beyond which nothing is averaged
constexpr double kDelayPrior = 4.0;  // ridge on each delay, beside rows in N m or N: weak against any motion
constexpr double kSlightRidge = 1e-9;  // relative, on the diagonal: columns that the motions do not separate
constexpr std::array kLags{-1, 0, 1, 2};                         // samples, tried for RowSetting::torque_lag
constexpr std::array kWidths{.003, .006, .01, .016, .025, .05};  // rad/s or m/s, of friction

/// Whether the log has no velocity, or one that is the difference of the positions, so not independent.
bool holds_no_velocity(const UniformLog& log) {
  if (log.dq.rows() == 0) return true;
  std::vector<double> time(log.rows());
  for (int k = 0; k < log.rows(); ++k) time[k] = log.time_s(k);
  const auto column = [&](const MatrixXd& values, int j) {
    return std::span<const double>(values.col(j).data(), static_cast<std::size_t>(values.rows()));
  };
  for (int j = 0; j < log.joints(); ++j)
    if (!is_difference(time, column(log.q, j), column(log.dq, j))) return false;
  return true;
}

std::vector<BalanceRows> rows_of(const std::vector<UniformLog>& logs, const RowSetting& setting,
                                 const RigidColumns& rigid) {
  std::vector<BalanceRows> out;
  for (const UniformLog& log : logs) out.push_back(balance_rows(log, setting, rigid, {}));
  return out;
}

/// Returns the sum of squared residuals of joint `j` with parameters `theta`, and the number of rows.
std::pair<double, double> left(const std::vector<BalanceRows>& rows, const VectorXd& theta, int j) {
  double sum = 0.0, count = 0.0;
  for (const BalanceRows& log : rows) {
    sum += (log.torque.col(j) - log.column[j] * theta).squaredNorm();
    count += log.rows();
  }
  return {sum, count};
}

VectorXd left_rms(const std::vector<BalanceRows>& rows, const VectorXd& theta, int joints) {
  VectorXd out(joints);
  for (int j = 0; j < joints; ++j) {
    const auto [sum, count] = left(rows, theta, j);
    out[j] = std::sqrt(sum / count);
  }
  return out;
}

}  // namespace

bool hold_no_velocity(const std::vector<UniformLog>& logs) {
  return std::all_of(logs.begin(), logs.end(), holds_no_velocity);
}

RowSetting draft_setting(const std::vector<UniformLog>& logs, double kernel_s, double row_s) {
  RowSetting out;
  const UniformLog& first = logs.front();
  out.period_s = first.period_s;
  out.kernel_s = kernel_s;
  out.decimation = std::max(1, static_cast<int>(std::lround(row_s / out.period_s)));
  const int n = first.joints();
  out.friction_width = VectorXd::Constant(n, 0.01);
  out.compliance = VectorXd::Zero(n);
  out.fusion = VectorXd::Zero(n);
  std::vector<VectorXd> q, dq;
  for (const UniformLog& log : logs) {
    q.push_back(log.q_noise);
    if (log.dq.rows() == 0) return out;
    dq.push_back(log.dq_noise);
  }
  const VectorXd q_noise = joint_medians(q), dq_noise = joint_medians(dq);
  for (int j = 0; j < n; ++j)
    out.fusion[j] =
        elementary::exp(-std::min(dq_noise[j] / std::max(q_noise[j], 1e-9) * out.period_s, kMostDecay));
  return out;
}

std::vector<bool> rigid_columns_used(const RigidColumns& rigid, const ColumnLayout& layout) {
  std::vector<bool> used(layout.count(), true);
  for (int j = 0; j < layout.joints; ++j) {
    used[layout.offset(j)] = !carries_weight(rigid, j);
    used[layout.spring(j)] = false;
  }
  for (int r = layout.ripple(0); r < layout.count(); ++r) used[r] = false;
  for (int p = 0; p < layout.base; ++p)
    if (is_rotor(rigid, p)) used[p] = false;
  return used;
}

VectorXd plain_fit(const std::vector<BalanceRows>& rows, const ColumnLayout& layout,
                   const std::vector<bool>& used, const VectorXd& scale) {
  const int count = layout.count(), joints = layout.joints;
  MatrixXd a = MatrixXd::Zero(count, count);
  for (int j = 0; j < joints; ++j) a(layout.delay(j), layout.delay(j)) = kDelayPrior;
  VectorXd b = VectorXd::Zero(count);
  for (const BalanceRows& log : rows)
    for (int j = 0; j < joints; ++j) {
      const MatrixXd y = log.column[j] / scale[j];
      a += y.transpose() * y;
      b += y.transpose() * (log.torque.col(j) / scale[j]);
    }
  std::vector<int> free;
  for (int p = 0; p < count; ++p)
    if (used[p] && a(p, p) > 0.0) free.push_back(p);
  MatrixXd part = a(free, free);
  part.diagonal() *= 1.0 + kSlightRidge;
  VectorXd theta = VectorXd::Zero(count);
  const VectorXd some = b(free), solution = part.ldlt().solve(some);
  theta(free) = solution;
  return theta;
}

RowSetting with_chosen_lag_and_widths(const std::vector<UniformLog>& logs, const RigidColumns& rigid,
                                      RowSetting setting) {
  const int n = rigid.joints();
  const ColumnLayout layout = layout_of(rigid, setting);
  const std::vector<bool> used = rigid_columns_used(rigid, layout);
  double least = std::numeric_limits<double>::infinity();
  int best_lag = 0;
  VectorXd scale = VectorXd::Ones(n);
  for (const int lag : kLags) {
    setting.torque_lag = lag;
    const std::vector<BalanceRows> rows = rows_of(logs, setting, rigid);
    const VectorXd theta = plain_fit(rows, layout, used, VectorXd::Ones(n));
    const VectorXd rms = left_rms(rows, theta, n);
    double nats = 0.5 * theta.segment(layout.delay(0), n).squaredNorm() / Eigen::numext::abs2(kDelayStd);
    for (const BalanceRows& log : rows)
      for (int j = 0; j < n; ++j) nats += log.rows() * elementary::log(rms[j]);
    if (nats >= least) continue;
    least = nats;
    best_lag = lag;
    scale = rms;
  }
  setting.torque_lag = best_lag;
  std::vector<BalanceRows> rows = rows_of(logs, setting, rigid);
  for (int j = 0; j < n; ++j) {
    double narrowest = std::numeric_limits<double>::infinity(), best = setting.friction_width[j];
    for (const double width : kWidths) {
      setting.friction_width[j] = width;
      for (std::size_t d = 0; d < logs.size(); ++d)
        rows[d].column[j].col(layout.coulomb(j)) = friction_columns(logs[d], setting, j).col(1);
      const double sum = left(rows, plain_fit(rows, layout, used, scale), j).first;
      if (sum >= narrowest) continue;
      narrowest = sum;
      best = width;
    }
    setting.friction_width[j] = best;
    for (std::size_t d = 0; d < logs.size(); ++d)
      rows[d].column[j].col(layout.coulomb(j)) = friction_columns(logs[d], setting, j).col(1);
  }
  return setting;
}

}  // namespace faultline
