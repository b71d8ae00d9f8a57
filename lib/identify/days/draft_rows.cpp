// SPDX-License-Identifier: MIT
#include "lib/identify/days/draft_rows.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lib/balance/rest.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"
#include "lib/log/derived_velocity.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kMostDecay = 5.0;    // samples^-1: crossover of the fusion beyond which nothing is averaged
constexpr double kLeastDecay = 1e-3;  // the same, below which a velocity without noise would never forget
constexpr double kDelayPrior = 4.0;   // ridge on each delay, beside rows in N m or N: weak against any motion
constexpr double kFewestAtRest = 20.0;     // rows at rest, and in motion, to decide whether a joint sticks
constexpr double kSticks = 1.6;            // least ratio of the residuals at rest and in motion, rms
constexpr double kSticksOfFriction = 0.2;  // least ratio of the residual at rest to the Coulomb friction
constexpr double kMostAtRest = 0.995,
                 kStictionSlack = 1.25;  // quantile of the residuals at rest, and times it
constexpr double kSlightRidge = 1e-9;  // relative, on the diagonal: columns that the motions do not separate
constexpr std::array kLags{-1, 0, 1, 2};  // samples, tried for RowSetting::torque_lag
constexpr std::array kTriedWidths{.003, .006, .01, .016, .025, .05};  // rad/s or m/s, of friction

/// Returns the rows of the logs without lost ones and without silent balances.
std::vector<BalanceRows> rows_of(const std::vector<UniformLog>& logs, const RowSetting& setting,
                                 const BalanceModel& model) {
  std::vector<BalanceRows> out;
  const int n = model.joints();
  for (const UniformLog& log : logs) {
    BalanceRows rows = balance_rows(log, setting, model.rigid, {});
    JointMask mask = silent_balances(rows, model);
    if (mask.size() == 0) mask.setConstant(rows.rows(), n, false);
    for (int k = 0; k < rows.rows(); ++k)
      if (rows.lost[k]) mask.row(k).setConstant(true);
    out.push_back(without_balances(std::move(rows), mask));
  }
  return out;
}

/// Sets the Coulomb friction of a joint to that of the setting's width.
void renew_friction(const std::vector<UniformLog>& logs, const RowSetting& setting, const BalanceModel& model,
                    int j, std::vector<BalanceRows>& rows) {
  const Eigen::Index coulomb = layout_of(model.rigid, setting).coulomb(j);
  for (std::size_t d = 0; d < logs.size(); ++d) {
    rows[d].column[j].col(coulomb) = friction_columns(logs[d], setting, j).col(1);
    const JointMask mask = silent_balances(rows[d], model);
    for (int k = 0; k < rows[d].rows(); ++k)
      if (rows[d].lost[k] || (mask.size() > 0 && mask(k, j))) rows[d].column[j](k, coulomb) = 0.0;
  }
}

/// Residuals of a joint at rest and in motion, as square sums with their numbers of rows.
struct RestAndMotion {
  double rest = 0.0, rest_rows = 0.0, motion = 0.0, motion_rows = 0.0;
  std::vector<double> sizes;  ///< of those at rest
};

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

std::vector<bool> derived_velocities(const std::vector<UniformLog>& logs) {
  std::vector<bool> out(logs.front().joints(), false);
  for (const UniformLog& log : logs) {
    if (log.dq.rows() == 0) continue;
    std::vector<double> time(log.rows());
    for (int k = 0; k < log.rows(); ++k) time[k] = log.time_s(k);
    const auto column = [&](const MatrixXd& values, int j) {
      return std::span<const double>(values.col(j).data(), time.size());
    };
    for (int j = 0; j < log.joints(); ++j)
      out[j] = out[j] || is_derived(time, column(log.q, j), column(log.dq, j));
  }
  return out;
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
    out.fusion[j] = elementary::exp(
        -std::clamp(dq_noise[j] / std::max(q_noise[j], 1e-9) * out.period_s, kLeastDecay, kMostDecay));
  return out;
}

std::vector<bool> rigid_columns_used(const RigidColumns& rigid, const ColumnLayout& layout) {
  std::vector<bool> used(layout.count(), true);
  for (int j = 0; j < layout.joints; ++j) {
    used[layout.offset(j)] = !carries_weight(rigid, j);
    used[layout.load(j)] = used[layout.spring(j)] = false;
  }
  for (int p = layout.drive(0); p < layout.count(); ++p) used[p] = false;
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

VectorXd static_friction(const std::vector<UniformLog>& logs, const BalanceModel& model) {
  const int n = model.joints();
  const ColumnLayout layout = model.layout();
  BalanceModel all_stick = model;
  all_stick.stiction = VectorXd::Ones(n);
  const std::vector<BalanceRows> moving = rows_of(logs, model.setting, all_stick);
  const VectorXd theta = plain_fit(moving, layout, rigid_columns_used(model.rigid, layout), model.torque_rms);
  std::vector<RestAndMotion> joint(n);
  for (const UniformLog& log : logs) {
    const BalanceRows rows = balance_rows(log, model.setting, model.rigid, {});
    const JointMask rests = sticking_rows(rows, all_stick);
    const MatrixXd left = rows.torque - torque_of(rows, theta);
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < rows.rows(); ++k) {
        if (rows.lost[k]) continue;
        const double square = Eigen::numext::abs2(left(k, j));
        (rests(k, j) ? joint[j].rest : joint[j].motion) += square;
        (rests(k, j) ? joint[j].rest_rows : joint[j].motion_rows) += 1.0;
        if (rests(k, j)) joint[j].sizes.push_back(std::abs(left(k, j)));
      }
  }
  VectorXd out = VectorXd::Zero(n);
  for (int j = 0; j < n; ++j) {
    const RestAndMotion& of = joint[j];
    if (of.rest_rows < kFewestAtRest || of.motion_rows < kFewestAtRest) continue;
    const double rest = std::sqrt(of.rest / of.rest_rows), motion = std::sqrt(of.motion / of.motion_rows),
                 coulomb = theta[layout.coulomb(j)];
    if (rest < kSticks * motion || rest < kSticksOfFriction * coulomb) continue;
    out[j] = kStictionSlack * std::max(upper_quantile(of.sizes, kMostAtRest), coulomb);
  }
  return out;
}

RowSetting with_chosen_lag_and_widths(const std::vector<UniformLog>& logs, const BalanceModel& model) {
  const RigidColumns& rigid = model.rigid;
  RowSetting setting = model.setting;
  const int n = rigid.joints();
  const ColumnLayout layout = layout_of(rigid, setting);
  const std::vector<bool> used = rigid_columns_used(rigid, layout);
  double least = std::numeric_limits<double>::infinity();
  int best_lag = 0;
  VectorXd scale = VectorXd::Ones(n);
  for (const int lag : kLags) {
    setting.torque_lag = lag;
    const std::vector<BalanceRows> rows = rows_of(logs, setting, model);
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
  std::vector<BalanceRows> rows = rows_of(logs, setting, model);
  for (int j = 0; j < n; ++j) {
    double narrowest = std::numeric_limits<double>::infinity(), best = setting.friction_width[j];
    for (const double width : kTriedWidths) {
      setting.friction_width[j] = width;
      renew_friction(logs, setting, model, j, rows);
      const double sum = left(rows, plain_fit(rows, layout, used, scale), j).first;
      if (sum >= narrowest) continue;
      narrowest = sum;
      best = width;
    }
    setting.friction_width[j] = best;
    renew_friction(logs, setting, model, j, rows);
  }
  return setting;
}

}  // namespace faultline
