// SPDX-License-Identifier: MIT
#include "lib/explain/row_deviation.hpp"

#include <algorithm>
#include <cmath>

#include "lib/explain/end_stop.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kModelShare = 0.004;  // of each model term: what a model of a machine lacks
constexpr double kLeastLoud = 0.3, kMostLoud = 4.0;

/// Squares of the terms of the model, each a column times its parameter, inertia, gravity and friction.
MatrixXd squared_terms(const BalanceRows& rows, const ColumnLayout& layout, const VectorXd& theta) {
  MatrixXd out(rows.rows(), rows.joints());
  const int rigid = layout.rigid();
  for (int j = 0; j < rows.joints(); ++j)
    out.col(j) = (rows.column[j].leftCols(rigid) * theta.head(rigid).asDiagonal()).rowwise().squaredNorm();
  return out;
}

}  // namespace

VectorXd row_loudness(const UniformLog& log, const BalanceModel& model) {
  const bool by_position = model.setting.velocity_is_difference || log.dq.rows() == 0;
  const VectorXd now = sample_noise(by_position ? log.q : log.dq);
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

}  // namespace faultline
