// SPDX-License-Identifier: MIT
#include "lib/explain/log_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/balance/smoothing.hpp"
#include "lib/explain/end_stop.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kModelShare = 0.004;  // of each model term: what a model of a machine lacks
constexpr double kLeastLoud = 0.3, kMostLoud = 4.0;
constexpr double kChangeDoubt_rows = 0.6;  // standard deviation of the time of a change of the work piece
constexpr double kSaysNothing = 1e9;
constexpr double kGravity = 9.81;
constexpr int kMostPaths = 4;   // rounds of path and effects in turn
constexpr int kBeforeRows = 5;  // effects before an onset are estimated anew for each so many rows

VectorXd loudness_of(const UniformLog& log, const BalanceModel& model) {
  const bool by_position = model.setting.velocity_is_difference || log.dq.rows() == 0;
  const VectorXd now = sample_noise(by_position ? log.q : log.dq);
  const VectorXd& usual = by_position ? model.q_noise : model.dq_noise;
  VectorXd out(now.size());
  for (int j = 0; j < out.size(); ++j)
    out[j] = std::clamp(usual[j] > 0.0 ? now[j] / usual[j] : 1.0, kLeastLoud, kMostLoud);
  return out;
}

/// Squares of the terms of the model, each a column times its parameter, inertia, gravity and friction.
MatrixXd squared_terms(const BalanceRows& rows, const ColumnLayout& layout, const VectorXd& theta) {
  MatrixXd out(rows.rows(), rows.joints());
  const int rigid = layout.rigid();
  for (int j = 0; j < rows.joints(); ++j)
    out.col(j) = (rows.column[j].leftCols(rigid) * theta.head(rigid).asDiagonal()).rowwise().squaredNorm();
  return out;
}

}  // namespace

double Explanation::mean_square() const {
  double sum = 0.0, count = 0.0;
  for (const double v : left)
    if (!std::isnan(v)) sum += v * v, count += 1.0;
  return count > 0.0 ? sum / count : 1.0;
}

MatrixXd unstacked(const Stacked& values, int joints) {
  return Eigen::Map<const MatrixXd>(values.data(), values.size() / joints, joints);
}

Stacked stacked(const MatrixXd& values) { return Eigen::Map<const VectorXd>(values.data(), values.size()); }

LogFit::LogFit(UniformLog log, const BalanceModel& model)
    : log_(std::move(log)),
      model_(model),
      rows_(balance_rows(log_, model.setting, model.rigid, model.theta)),
      loudness_(loudness_of(log_, model)) {
  const ColumnLayout layout = model.layout();
  tip_ = payload_torque(rows_, model.payload, joints() - 1);
  residual_ = stacked(rows_.torque - torque_of(rows_, model.theta));
  MatrixXd spring(count(), joints());
  for (int j = 0; j < joints(); ++j)
    spring.col(j) = rows_.column[j].middleCols(layout.spring(0), joints()) *
                    model.theta.segment(layout.spring(0), joints());
  spring_ = stacked(spring);
  std_ = row_std(rows_, model.setting, model.noise, loudness_);
  const MatrixXd stop = stop_std(rows_, model);
  std_ = (std_.array().square() + stop.array().square() +
          kModelShare * kModelShare * squared_terms(rows_, layout, model.theta).array())
             .sqrt();
  day_column_ = faultline::day_columns(rows_, layout, model.theta);
  const int effects = static_cast<int>(model.day_variance.size());
  StackedColumns day(count() * joints(), effects);
  for (int j = 0; j < joints(); ++j) day.middleRows(j * count(), count()) = day_column_[j];
  day_white_ = whitened(day);
  day_square_ = day_white_.transpose() * day_white_;
  day_precision_ = model.day_variance.cwiseInverse();
  if (!has_piece()) {
    healthy_ = explain(residual_, {}, {});
    return;
  }
  first_path_ = path_of(residual_, {}, true);
  PiecePath path = first_path_;
  healthy_.log_likelihood = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < kMostPaths; ++round) {
    Explanation fit = explain(residual_, {}, path);
    PiecePath next = path_of(residual_ - day_torque(fit.day), {}, false);
    if (fit.log_likelihood > healthy_.log_likelihood) healthy_ = std::move(fit);
    if (next == path) break;
    path = std::move(next);
  }
}

Stacked LogFit::residual_of(const UniformLog& moved) const {
  return stacked(faultline::residual_of(moved, model_.setting, model_.rigid, model_.theta)) - spring_;
}

StackedColumns LogFit::whitened(const StackedColumns& columns) const {
  StackedColumns out(columns.rows(), columns.cols());
  for (int j = 0; j < joints(); ++j)
    out.middleRows(j * count(), count()) =
        whiten(columns.middleRows(j * count(), count()), std_.col(j), model_.noise.joint[j]);
  return out;
}

Stacked LogFit::whitened(const Stacked& torque) const { return whitened(StackedColumns(torque)).col(0); }

Stacked LogFit::day_torque(const VectorXd& day) const {
  Stacked out(count() * joints());
  for (int j = 0; j < joints(); ++j) out.segment(j * count(), count()) = day_column_[j] * day;
  return out;
}

Stacked LogFit::piece_torque(const VectorXd& level) const {
  return stacked(model_.piece_kg * (tip_.array().colwise() * level.array()).matrix());
}

Explanation LogFit::explain(const Stacked& residual, const FaultColumns& columns, const PiecePath& path,
                            const StackedMask& dropped) const {
  Explanation out;
  Stacked y = residual;
  StackedColumns x = columns.column;
  VectorXd variance = columns.variance;
  if (x.rows() == 0) x.resize(residual.size(), 0);
  int changes = 0;
  if (!path.empty()) {
    const PieceRamps ramps = piece_ramps(path, time_s(), model_.setting.kernel_s);
    out.path = path;
    out.piece_level = ramps.level;
    y -= piece_torque(ramps.level);
    changes = static_cast<int>(ramps.change.cols());
    const int k = static_cast<int>(x.cols());
    x.conservativeResize(Eigen::NoChange, k + changes);
    for (int c = 0; c < changes; ++c) x.col(k + c) = piece_torque(ramps.change.col(c));
    variance.conservativeResize(k + changes);
    variance.tail(changes).setConstant(Eigen::numext::abs2(kChangeDoubt_rows * model_.setting.row_s()));
  }
  const int effects = static_cast<int>(day_precision_.size()), sizes = static_cast<int>(x.cols());
  Stacked z = whitened(y);
  StackedColumns xw = whitened(x);
  NormalEquations sums;
  sums.matrix.resize(effects + sizes, effects + sizes);
  sums.vector.resize(effects + sizes);
  double lost = 0.0;
  if (dropped.empty()) {
    sums.matrix.topLeftCorner(effects, effects) = day_square_;
    sums.vector.head(effects) = day_white_.transpose() * z;
    sums.matrix.topRightCorner(effects, sizes) = day_white_.transpose() * xw;
    sums.square = z.squaredNorm();
    sums.vector.tail(sizes) = xw.transpose() * z;
    sums.matrix.bottomRightCorner(sizes, sizes) = xw.transpose() * xw;
  } else {
    VectorXd keep(z.size());
    for (Eigen::Index i = 0; i < z.size(); ++i) keep[i] = dropped[i] ? 0.0 : 1.0;
    lost = static_cast<double>(keep.size()) - keep.sum();
    const StackedColumns day = keep.asDiagonal() * day_white_;
    const StackedColumns kept = keep.asDiagonal() * xw;
    sums.matrix.topLeftCorner(effects, effects) = day.transpose() * day_white_;
    sums.vector.head(effects) = day.transpose() * z;
    sums.matrix.topRightCorner(effects, sizes) = day.transpose() * xw;
    sums.square = z.cwiseProduct(keep).squaredNorm();
    sums.vector.tail(sizes) = kept.transpose() * z;
    sums.matrix.bottomRightCorner(sizes, sizes) = kept.transpose() * xw;
  }
  sums.matrix.bottomLeftCorner(sizes, effects) = sums.matrix.topRightCorner(effects, sizes).transpose();
  VectorXd precision(effects + sizes);
  precision << day_precision_, variance.cwiseInverse();
  const Regression fit = regress(sums, precision);
  out.day = fit.estimate.head(effects);
  out.size = fit.estimate.segment(effects, columns.sizes());
  out.log_likelihood = fit.log_likelihood - 0.5 * lost - kChangeOfPiece * changes;
  out.left = z - day_white_ * out.day - xw * fit.estimate.tail(sizes);
  for (std::size_t i = 0; i < dropped.size(); ++i)
    if (dropped[i]) out.left[static_cast<Eigen::Index>(i)] = std::numeric_limits<double>::quiet_NaN();
  return out;
}

Explanation LogFit::explain_with_piece(const Stacked& residual, const FaultColumns& columns,
                                       const std::vector<VectorXd>& starts, double onset_s,
                                       const StackedMask& dropped) const {
  if (!has_piece()) return explain(residual, columns, {}, dropped);
  Explanation best;
  best.log_likelihood = -std::numeric_limits<double>::infinity();
  const auto try_start = [&](PiecePath path) {
    for (int round = 0; round < kMostPaths; ++round) {
      Explanation fit = explain(residual, columns, path, dropped);
      Stacked left = residual - day_torque(fit.day);
      if (columns.sizes() > 0) left -= columns.column * fit.size;
      PiecePath next = path_of(left, dropped, false);
      if (fit.log_likelihood > best.log_likelihood) best = std::move(fit);
      if (next == path) break;
      path = std::move(next);
    }
  };
  try_start(healthy_.path);
  for (const VectorXd& size : starts) {
    Stacked left = residual - day_torque(day_before(onset_s));
    if (columns.sizes() > 0) left -= columns.column * size;
    try_start(path_of(left, dropped, true));
  }
  return best;
}

PiecePath LogFit::path_of(const Stacked& left, const StackedMask& dropped, bool wide) const {
  const double step = model_.piece_kg * kGravity;
  MatrixXd std(count(), joints());
  for (int j = 0; j < joints(); ++j) {
    if (carries_weight(model_.rigid, j))
      std.col(j).setConstant(wide ? 0.25 * step : std::max(0.3, 0.03 * step));
    else
      std.col(j) = 4.0 * std_.col(j) + 0.02 * rows_.torque.col(j).cwiseAbs();
  }
  Eigen::Map<VectorXd> flat(std.data(), std.size());
  for (std::size_t i = 0; i < dropped.size(); ++i)
    if (dropped[i]) flat[static_cast<Eigen::Index>(i)] = kSaysNothing;
  return piece_path(unstacked(left, joints()), model_.piece_kg * tip_, std);
}

VectorXd LogFit::day_before(double time) const {
  const double until = time - 2.0 * model_.setting.kernel_s;
  int row = 0;
  while (row < count() && time_s()[row] < until) ++row;
  const int key = row / kBeforeRows;
  for (const auto& [known, day] : before_)
    if (known == key) return day;
  StackedMask dropped(count() * joints(), false);
  for (int j = 0; j < joints(); ++j)
    for (int k = row; k < count(); ++k) dropped[j * count() + k] = true;
  VectorXd day = explain(residual_, {}, first_path_, dropped).day;
  before_.emplace_back(key, day);
  return day;
}

VectorXd LogFit::soft_step(double onset_s) const {
  const double width = std::max(model_.setting.kernel_s, 0.3 * model_.setting.row_s());
  return time_s().unaryExpr([&](double t) { return normal_cdf((t - onset_s) / width); });
}

}  // namespace faultline
