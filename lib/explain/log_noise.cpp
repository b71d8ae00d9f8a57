// SPDX-License-Identifier: MIT
#include "lib/explain/log_noise.hpp"

#include <algorithm>
#include <cmath>

#include "lib/balance/end_stop.hpp"
#include "lib/balance/work_piece.hpp"
#include "lib/core/statistics.hpp"
#include "lib/explain/free_form.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kModelShare = 0.004;                // of each model term: what a model of a machine lacks
constexpr double kLeastLoud = 0.3, kMostLoud = 4.0;  // bounds of the noise, times that of the healthy logs

/// Squares of the terms of the model, each a column times its parameter, inertia, gravity and friction.
MatrixXd squared_terms(const BalanceRows& rows, const ColumnLayout& layout, const VectorXd& theta) {
  MatrixXd out(rows.rows(), rows.joints());
  const int rigid = layout.rigid();
  for (int j = 0; j < rows.joints(); ++j)
    out.col(j) = (rows.column[j].leftCols(rigid) * theta.head(rigid).asDiagonal()).rowwise().squaredNorm();
  return out;
}

/// From the first motion of the log on, unless it changes before: rows that count in any case. A log at rest
/// says nothing of its noise.
constexpr double kFirstStretch_s = 2.0, kFirstStretch = 0.3;
constexpr double kJustBefore_s = 0.2;  // s before the first motion: the kernels reach less far
constexpr double kMoves = 0.05;        // of a joint's greatest healthy speed
constexpr double kLost = 1e3;          // times the least standard deviation: a row that does not count
constexpr double kMostRows = 0.8, kFarLouder = 3.0;  // quantile, and times it: a larger row is no noise

/// Sums of products of rows that lie 0, 1, .. `order` apart.
VectorXd lag_products(const VectorXd& rows, Eigen::Index order) {
  VectorXd out = VectorXd::Zero(order + 1);
  for (Eigen::Index lag = 0; lag <= order && lag < rows.size(); ++lag)
    out[lag] = rows.head(rows.size() - lag).dot(rows.tail(rows.size() - lag));
  return out;
}

/// Size beyond which a row behind a change is part of a fault and no noise: far above most rows of the log's
/// motion.
double loudest_noise(const Eigen::Ref<const VectorXd>& rows, double usual) {
  const VectorXd size = rows.cwiseAbs();
  const double most = upper_quantile({size.begin(), size.end()}, kMostRows);
  return kFarLouder * std::max(usual, std::isnan(most) ? 0.0 : most);
}

/// When any joint first moves; the first row where none does.
double first_motion_s(const LogFit& fit) {
  const VectorXd& top = fit.model().top_speed;
  for (int k = 0; k < fit.count(); ++k)
    if ((fit.rows().dq.row(k).transpose().cwiseAbs().array() > kMoves * top.array()).any())
      return fit.time_s()[k];
  return fit.time_s()[0];
}

}  // namespace

VectorXd row_loudness(const UniformLog& log, const BalanceModel& model) {
  const bool by_position = model.setting.velocity_is_difference || log.dq.rows() == 0;
  const VectorXd& now = by_position ? log.q_noise : log.dq_noise;
  const VectorXd& usual = by_position ? model.q_noise : model.dq_noise;
  VectorXd out(now.size());
  for (int j = 0; j < out.size(); ++j)
    out[j] = std::clamp(usual[j] > 0.0 ? now[j] / usual[j] : 1.0, kLeastLoud, kMostLoud);
  return out;
}

MatrixXd row_deviation(const BalanceRows& rows, const BalanceModel& model, const VectorXd& loudness) {
  const MatrixXd noise = row_std(rows, model.setting, model.noise, loudness), stop = stop_std(rows, model),
                 terms = squared_terms(rows, model.layout(), model.theta);
  return (noise.array().square() + stop.array().square() + kModelShare * kModelShare * terms.array()).sqrt();
}

RowNoise own_noise(const LogFit& fit) {
  const Change change = first_change(fit);
  const Stacked torque = torque_without_piece(fit) - fit.day_torque(change.day);
  const std::vector<bool> near = near_change(fit.first_path(), kRowsOfChange);
  const double motion_s = first_motion_s(fit),
               first_s = change.onset_s > motion_s - kJustBefore_s ? motion_s : fit.time_s()[0],
               length_s = fit.time_s()[fit.count() - 1] - first_s;
  const double until_s = std::max(change.onset_s - fit.model().setting.kernel_s,
                                  first_s + std::min(kFirstStretch_s, kFirstStretch * length_s));
  RowNoise out = fit.model().noise;
  const int rows = fit.first_row(until_s), moving = std::min(rows, fit.first_row(first_s)),
            changed = fit.first_row(change.onset_s);
  for (int j = 0; j < fit.joints(); ++j) {
    JointNoise& noise = out.joint[j];
    const VectorXd std = fit.std().col(j);
    VectorXd scaled = torque.segment(j * fit.count(), rows).cwiseQuotient(std.head(rows));
    const VectorXd usual = autocovariance(noise);
    const double loudest = loudest_noise(scaled.tail(rows - moving), std::sqrt(usual[0]));
    double count = kRowsOfHealthyLogs;
    for (int k = 0; k < rows; ++k) {
      const bool is_fault = k >= changed && std::abs(scaled[k]) > loudest;
      const bool counts = !is_fault && std[k] < kLost * std.minCoeff() && (near.empty() || !near[k]);
      scaled[k] *= counts ? 1.0 : 0.0;
      count += counts ? 1.0 : 0.0;
    }
    const VectorXd own = (kRowsOfHealthyLogs * usual + lag_products(scaled, usual.size() - 1)) / count;
    if (own[0] > usual[0]) noise = with_autocovariance(std::move(noise), own);
  }
  return out;
}

}  // namespace faultline
