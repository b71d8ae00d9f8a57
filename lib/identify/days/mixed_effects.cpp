// SPDX-License-Identifier: MIT
#include "lib/identify/days/mixed_effects.hpp"

#include <cmath>

#include "lib/identify/days/day_arrow.hpp"
#include "lib/identify/days/draft_rows.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTinyRidge = 1e-9, kTiniest = 1e-12;  // for columns that these motions do not move
constexpr double kPieceForce = 9.81;                   // N of 1 kg that may be there or not

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
    const Eigen::Index robot = y.cols(), effects = w.cols();
    NormalEquations sums{MatrixXd::Zero(robot + effects, robot + effects), VectorXd(robot + effects)};
    sums.matrix.topLeftCorner(robot, robot) = y.transpose() * y;
    sums.matrix.bottomLeftCorner(effects, robot) = w.transpose() * y;
    sums.matrix.bottomRightCorner(effects, effects) = w.transpose() * w;
    sums.vector << y.transpose() * r, w.transpose() * r;
    out.push_back(day_block(sums, between));
  }
  return out;
}

/// Parameters of the robot by all days but `left_out`.
VectorXd theta_without(const std::vector<DayBlock>& blocks, const DayDraft& draft,
                       const std::vector<int>& free, std::size_t left_out) {
  const ColumnLayout layout = draft.model.layout();
  auto [a, b, square, rows] = robot_sums(blocks, left_out);
  for (Eigen::Index i = 0; i < b.size(); ++i)
    if (free[i] >= layout.delay(0) && free[i] < layout.spring(0)) a(i, i) += 1.0 / (kDelayStd * kDelayStd);
  a.diagonal() *= 1.0 + kTinyRidge;
  a.diagonal().array() += kTiniest;
  return a.ldlt().solve(b);
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
  const EffectMoments moments = effect_moments(blocks, theta);
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
    out.push_back({all_parameters(draft.model, free, theta), effect_moments(blocks, theta, d).about_mean()});
  }
  return out;
}

}  // namespace faultline
