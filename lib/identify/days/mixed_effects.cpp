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

/// What one day adds to the normal equations of the robot, its effects eliminated.
struct DayBlock {
  Eigen::LLT<MatrixXd> factor;  ///< of the effects
  MatrixXd cross;               ///< effects x parameters
  VectorXd vector;              ///< of the effects
  MatrixXd robot_matrix;
  VectorXd robot_vector;

  VectorXd effect(const VectorXd& theta) const { return factor.solve(vector - cross * theta); }
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

std::vector<DayBlock> day_blocks(const DayDraft& draft, const std::vector<int>& free,
                                 const VectorXd& between) {
  std::vector<DayBlock> out;
  for (const HealthyDay& day : draft.days) {
    const RowNoise& noise = draft.model.noise;
    const MatrixXd y = whitened(day.rows.column, day, noise)(Eigen::all, free);
    const MatrixXd w = whitened(day.day_column, day, noise);
    const VectorXd r = whitened(day.rows.torque - day.piece, day, noise);
    MatrixXd own = w.transpose() * w;
    own.diagonal() += between.cwiseInverse();
    DayBlock block{Eigen::LLT<MatrixXd>(own), w.transpose() * y, w.transpose() * r, {}, {}};
    block.robot_matrix = y.transpose() * y - block.cross.transpose() * block.factor.solve(block.cross);
    block.robot_vector = y.transpose() * r - block.cross.transpose() * block.factor.solve(block.vector);
    out.push_back(std::move(block));
  }
  return out;
}

constexpr std::size_t kNoDay = static_cast<std::size_t>(-1);

/// Parameters of the robot by all days but `left_out`.
VectorXd theta_without(const std::vector<DayBlock>& blocks, const DayDraft& draft,
                       const std::vector<int>& free, std::size_t left_out) {
  const auto count = static_cast<Eigen::Index>(free.size());
  const ColumnLayout layout = draft.model.layout();
  MatrixXd a = MatrixXd::Zero(count, count);
  VectorXd b = VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i)
    if (free[i] >= layout.delay(0) && free[i] < layout.spring(0)) a(i, i) += 1.0 / (kDelayStd * kDelayStd);
  for (std::size_t d = 0; d < blocks.size(); ++d) {
    if (d == left_out) continue;
    a += blocks[d].robot_matrix;
    b += blocks[d].robot_vector;
  }
  a.diagonal() *= 1.0 + kTinyRidge;
  a.diagonal().array() += kTiniest;
  return a.ldlt().solve(b);
}

/// Mean and second moments of the effects of all days but `left_out`, their doubt included.
struct EffectMoments {
  VectorXd mean, square;

  VectorXd about_mean() const { return square - mean.cwiseAbs2(); }
};

EffectMoments effect_moments(const std::vector<DayBlock>& blocks, const VectorXd& theta, Eigen::Index effects,
                             std::size_t left_out) {
  EffectMoments out{VectorXd::Zero(effects), VectorXd::Zero(effects)};
  double days = 0.0;
  for (std::size_t d = 0; d < blocks.size(); ++d) {
    if (d == left_out) continue;
    const VectorXd effect = blocks[d].effect(theta);
    out.mean += effect;
    out.square +=
        effect.cwiseAbs2() + blocks[d].factor.solve(MatrixXd::Identity(effects, effects)).diagonal();
    days += 1.0;
  }
  out.mean /= days;
  out.square /= days;
  return out;
}

VectorXd all_parameters(const BalanceModel& m, const std::vector<int>& free, const VectorXd& theta) {
  VectorXd out = VectorXd::Zero(m.layout().count());
  out(free) = theta;
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
  const std::vector<int> free = free_columns(draft);
  const std::vector<DayBlock> blocks = day_blocks(draft, free, between);
  const VectorXd theta = theta_without(blocks, draft, free, kNoDay);
  const EffectMoments moments = effect_moments(blocks, theta, between.size(), kNoDay);
  draft.model.theta = all_parameters(draft.model, free, theta);
  for (std::size_t d = 0; d < blocks.size(); ++d)
    draft.days[d].effect = blocks[d].effect(theta) - moments.mean;
  return {std::move(draft), moments.about_mean()};
}

std::vector<RobotWithoutDay> fit_without_each_day(const DayDraft& draft, const VectorXd& between) {
  const std::vector<int> free = free_columns(draft);
  const std::vector<DayBlock> blocks = day_blocks(draft, free, between);
  std::vector<RobotWithoutDay> out;
  for (std::size_t d = 0; d < blocks.size(); ++d) {
    const VectorXd theta = theta_without(blocks, draft, free, d);
    out.push_back({all_parameters(draft.model, free, theta),
                   effect_moments(blocks, theta, between.size(), d).about_mean()});
  }
  return out;
}

}  // namespace faultline
