// SPDX-License-Identifier: MIT
#include "lib/identify/days/mixed_effects.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDelayStd = 0.3;                      // samples
constexpr double kTinyRidge = 1e-9, kTiniest = 1e-12;  // for columns that these motions do not move
constexpr double kPieceForce = 9.81;                   // N of 1 kg that may be there or not

/// Effects of one day, eliminated.
struct DayBlock {
  Eigen::LLT<MatrixXd> factor;
  MatrixXd cross;
  VectorXd vector;
};

std::vector<int> free_columns(const DayDraft& draft) {
  std::vector<int> free;
  for (std::size_t p = 0; p < draft.used.size(); ++p)
    if (draft.used[p]) free.push_back(static_cast<int>(p));
  return free;
}

MatrixXd whitened(const std::vector<MatrixXd>& column, const HealthyDay& day, const RowNoise& noise) {
  const Eigen::Index rows = day.rows.rows();
  MatrixXd out(rows * day.rows.joints(), column.front().cols());
  for (int j = 0; j < day.rows.joints(); ++j)
    out.middleRows(j * rows, rows) = whiten(column[j], day.std.col(j), noise.joint[j]);
  return out;
}

VectorXd whitened(const MatrixXd& torque, const HealthyDay& day, const RowNoise& noise) {
  const Eigen::Index rows = day.rows.rows();
  VectorXd out(rows * torque.cols());
  for (int j = 0; j < torque.cols(); ++j)
    out.segment(j * rows, rows) = whiten(torque.col(j), day.std.col(j), noise.joint[j]);
  return out;
}

}  // namespace

DayDraft with_noise(DayDraft draft, int order) {
  BalanceModel& m = draft.model;
  std::vector<LeftOver> left;
  for (const HealthyDay& day : draft.days)
    left.push_back({&day.rows, left_over(day, m.theta), {}, rows_near_change(day, m)});
  m.noise = with_variance(left, m.setting, std::move(m.noise));
  for (std::size_t d = 0; d < left.size(); ++d) {
    HealthyDay& day = draft.days[d];
    day.std = row_std(day.rows, m.setting, m.noise, VectorXd::Ones(m.joints()));
    for (int k = 0; k < day.rows.rows() && m.piece_kg > 0.0; ++k)
      if (left[d].not_counted[k])
        day.std.row(k) =
            (day.std.row(k).array().square() + Eigen::numext::abs2(m.piece_kg * kPieceForce)).sqrt();
    left[d].std = day.std;
  }
  m.noise = with_filter(left, order, std::move(m.noise));
  return draft;
}

MixedEffects fit_mixed_effects(DayDraft draft, const VectorXd& between) {
  BalanceModel& m = draft.model;
  const std::vector<int> free = free_columns(draft);
  const int count = static_cast<int>(free.size()), effects = static_cast<int>(between.size());
  MatrixXd a = MatrixXd::Zero(count, count);
  VectorXd b = VectorXd::Zero(count);
  const ColumnLayout layout = m.layout();
  for (int i = 0; i < count; ++i)
    if (free[i] >= layout.delay(0) && free[i] < layout.spring(0)) a(i, i) += 1.0 / (kDelayStd * kDelayStd);
  std::vector<DayBlock> blocks;
  for (HealthyDay& day : draft.days) {
    const MatrixXd y = whitened(day.rows.column, day, m.noise)(Eigen::all, free);
    const MatrixXd w = whitened(day.day_column, day, m.noise);
    const VectorXd r = whitened(day.rows.torque - day.piece, day, m.noise);
    MatrixXd own = w.transpose() * w;
    own.diagonal() += between.cwiseInverse();
    DayBlock block{Eigen::LLT<MatrixXd>(own), w.transpose() * y, w.transpose() * r};
    a += y.transpose() * y - block.cross.transpose() * block.factor.solve(block.cross);
    b += y.transpose() * r - block.cross.transpose() * block.factor.solve(block.vector);
    blocks.push_back(std::move(block));
  }
  a.diagonal() *= 1.0 + kTinyRidge;
  a.diagonal().array() += kTiniest;
  const VectorXd theta = a.ldlt().solve(b);
  m.theta.setZero();
  m.theta(free) = theta;
  VectorXd mean = VectorXd::Zero(effects), square = VectorXd::Zero(effects);
  for (std::size_t d = 0; d < blocks.size(); ++d) {
    VectorXd& effect = draft.days[d].effect;
    effect = blocks[d].factor.solve(blocks[d].vector - blocks[d].cross * theta);
    mean += effect;
    square += effect.cwiseAbs2() + blocks[d].factor.solve(MatrixXd::Identity(effects, effects)).diagonal();
  }
  const double days = static_cast<double>(blocks.size());
  mean /= days;
  for (HealthyDay& day : draft.days) day.effect -= mean;
  return {std::move(draft), square / days - mean.cwiseAbs2()};
}

}  // namespace faultline
