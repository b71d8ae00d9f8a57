// SPDX-License-Identifier: MIT
#include "lib/identify/days/fit_days.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/balance/rest.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/days/day_arrow.hpp"
#include "lib/identify/days/draft_rows.hpp"
#include "lib/identify/days/drive_limits.hpp"
#include "lib/identify/days/healthy_day.hpp"
#include "lib/identify/days/row_scale.hpp"
#include "lib/identify/parameter_space.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRowKernels = 2.0;  // kernels between two rows: finer rows repeat each other
constexpr int kFilterOrder = 3;      // of the autoregression of the rows
constexpr int kNoiseRounds = 3;  // each estimates the variance of the rows beside the autoregression before
constexpr int kFitRounds = 10;   // each fits parameters, days and noise in turn
// All rounds but the last, which take the noise as white: noise that wanders would explain what is constant
// in a day, such as a weight, and the fit would let it.
constexpr int kWhiteRounds = kFitRounds - 1;
// Rounds of the fit from which another term is tried: later terms need the earlier ones.
constexpr int kSpringsFrom = 2, kFinePathsFrom = 4, kRipplesAt = 4, kRowsUntil = 6;
constexpr int kPossibleFrom = 5;     // round from which terms with an impossible estimate are left out
constexpr int kWidthsAt[] = {3, 6};  // rounds that refine the friction widths

constexpr double kTopSpeed = 0.999;  // quantile of a joint's speed

constexpr double kTinyRidge = 1e-9, kTiniest = 1e-12;  // for columns that these motions do not excite
constexpr double kPieceForce = 9.81;                   // N: weight of 1 kg that may be carried or not

constexpr double kUnseenDays = 2.0;  // times the variance between the logged days: prior of an unseen day

/// Standard deviations of the effects: relative, but the offset as a share of the joint's torque rms and the
/// delay in samples.
struct EffectStd {
  double inertia, friction, slope, gain, offset, width, viscous, direction, load, delay;
};

// First: differences of robots from day to day. Least: differences that change no decision. Unseen:
// differences that a few days cannot show (friction by the warmth of the gear, inertia and torque constants
// by manufacture, friction near rest, where healthy logs have few rows, viscous friction, which warmth
// changes more than dry friction, and the loss of a gear by the torque that it carries).
constexpr EffectStd kFirst{.inertia = 1.7e-3,
                           .friction = 0.1,
                           .slope = 0.03,
                           .gain = 1.7e-3,
                           .offset = 2e-3,
                           .width = 0.1,
                           .viscous = 0.1,
                           .direction = 0.03,
                           .load = 0.01,
                           .delay = 0.1};
constexpr EffectStd kLeast{.inertia = 3e-4,
                           .friction = 0.01,
                           .slope = 3e-3,
                           .gain = 3e-4,
                           .offset = 2e-4,
                           .width = 0.02,
                           .viscous = 0.01,
                           .direction = 3e-3,
                           .load = 1e-3,
                           .delay = 0.01};
constexpr EffectStd kUnseen{.inertia = 1e-2,
                            .friction = 0.05,
                            .slope = 0.03,
                            .gain = 1e-2,
                            .offset = 5e-3,
                            .width = 0.1,
                            .viscous = 0.05,
                            .direction = 0.03,
                            .load = 0.02,
                            .delay = 0.3};

/// Returns the model with ranges, top speeds, noise and repeated positions of the healthy logs.
BalanceModel with_healthy_motion(const std::vector<UniformLog>& logs, BalanceModel m) {
  std::vector<VectorXd> q, dq;
  m = with_motion_of(logs, std::move(m));
  for (const UniformLog& log : logs) {
    q.push_back(log.q_noise);
    dq.push_back(log.dq.rows() > 0 ? log.dq_noise : log.q_noise);
    const MatrixXd speed = fused_velocity(log, m.setting).cwiseAbs();
    for (int j = 0; j < m.joints(); ++j) {
      std::vector<double> v(speed.col(j).data(), speed.col(j).data() + speed.rows());
      m.top_speed[j] = std::max(m.top_speed[j], upper_quantile(std::move(v), kTopSpeed));
    }
  }
  m.q_noise = joint_medians(q);
  m.dq_noise = joint_medians(dq);
  return m;
}

/// Returns rows, setting and a first fit of the rigid robot. Load friction and coupled drives are used where
/// `space` has them.
DayDraft first_draft(std::span<LogSource* const> logs, const ParameterSpace& space,
                     TorqueTiming torque_between_samples, const std::vector<double>& drive_limit) {
  const bool is_held = torque_between_samples == TorqueTiming::held;
  std::vector<UniformLog> uniform = uniform_logs(logs);
  const std::vector<bool> derived = derived_velocities(uniform);
  const RowScale scale = row_scale(uniform, derived);
  for (UniformLog& log : uniform) log = averaged(std::move(log), scale.averaged, is_held);
  DayDraft draft;
  BalanceModel& m = draft.model;
  m.rigid = {space.chain, space.lift};
  m.payload = payload_columns(space);
  m.setting = draft_setting(uniform, scale.kernel_s, kRowKernels * scale.kernel_s);
  m.setting.friction_s = scale.friction_s;
  for (int j = 0; j < m.setting.joints(); ++j)
    if (derived[j]) m.setting.fusion[j] = 0.0;
  m.setting.torque_is_held = is_held;
  m.setting.averaged = scale.averaged;
  for (const SharedDrive& drive : space.chain.shared_drives)
    m.setting.drives.push_back({drive.along, drive.width});
  for (const UniformLog& log : uniform) draft.days.push_back({.log = log});
  m = with_healthy_motion(uniform, std::move(m));
  m.stiction = m.drive_limit = VectorXd::Zero(m.joints());
  m.setting = with_chosen_lag_and_widths(uniform, m);
  m.stiction = static_friction(uniform, m);
  m.drive_limit =
      drive_limit.empty()
          ? drive_limits(uniform, m)
          : VectorXd(VectorXd::Map(drive_limit.data(), static_cast<Eigen::Index>(drive_limit.size())));
  if (!m.stiction.isZero(0.0) || !m.drive_limit.isZero(0.0))
    m.setting = with_chosen_lag_and_widths(uniform, m);
  draft = with_rows(std::move(draft));
  std::vector<BalanceRows> rows;
  for (const HealthyDay& day : draft.days) rows.push_back(without_balances(day.rows, day.rows.silent));
  draft.used = rigid_columns_used(m.rigid, m.layout());
  m.theta = plain_fit(rows, m.layout(), draft.used, m.torque_rms);
  for (int j = 0; j < m.joints(); ++j)
    draft.used[m.layout().spring(j)] = m.rigid.chain.geometry[j].kind == AxisKind::revolute;
  draft.extra = space.extra;
  for (const ExtraTerm& term : draft.extra)
    if (const auto column = column_of(term, m.layout())) draft.used[*column] = true;
  return draft;
}

/// Returns the draft with the nonlinear terms that this round may try, and with matching rows.
DayDraft with_terms_of_round(DayDraft draft, int round) {
  if (round == kWidthsAt[0] || round == kWidthsAt[1]) draft = with_refined_widths(std::move(draft));
  if (round == kRipplesAt) draft = with_ripples(std::move(draft));
  if (round == kSpringsFrom) draft = with_chosen_springs(std::move(draft));
  if (round >= kSpringsFrom) draft.model = with_compliance(std::move(draft.model));
  if (round >= kPossibleFrom) draft = without_impossible_terms(std::move(draft));
  if (round <= kRowsUntil) draft = with_rows(std::move(draft));
  return with_day_columns(std::move(draft));
}

std::vector<int> free_columns(const DayDraft& draft) {
  std::vector<int> free;
  for (std::size_t p = 0; p < draft.used.size(); ++p)
    if (draft.used[p]) free.push_back(static_cast<int>(p));
  return free;
}

MatrixXd whitened(const std::vector<MatrixXd>& column, const std::vector<Whitener>& white) {
  const Eigen::Index rows = column.front().rows();
  MatrixXd out(rows * std::ssize(white), column.front().cols());
  for (std::size_t j = 0; j < white.size(); ++j)
    out.middleRows(static_cast<Eigen::Index>(j) * rows, rows) = white[j](column[j]);
  return out;
}

VectorXd whitened(const MatrixXd& torque, const std::vector<Whitener>& white) {
  MatrixXd out(torque.rows(), torque.cols());
  for (Eigen::Index j = 0; j < torque.cols(); ++j) out.col(j) = white[j](torque.col(j));
  return out.reshaped();
}

/// Returns the block of one day; `free` are the parameters of the robot that are estimated.
DayBlock block_of(const HealthyDay& day, const BalanceModel& model, const std::vector<int>& free,
                  const VectorXd& between) {
  const std::vector<Whitener> white = whiteners(day.std, model.noise);
  const MatrixXd y = whitened(day.rows.column, white)(Eigen::all, free);
  const MatrixXd w = whitened(day.day_column, white);
  const VectorXd r = whitened(day.rows.torque - day.piece, white);
  const Eigen::Index robot = y.cols(), effects = w.cols();
  NormalEquations sums{MatrixXd::Zero(robot + effects, robot + effects), VectorXd(robot + effects)};
  sums.matrix.topLeftCorner(robot, robot) = y.transpose() * y;
  sums.matrix.bottomLeftCorner(effects, robot) = w.transpose() * y;
  sums.matrix.bottomRightCorner(effects, effects) = w.transpose() * w;
  sums.vector << y.transpose() * r, w.transpose() * r;
  return day_block(sums, between);
}

std::vector<DayBlock> day_blocks(const DayDraft& draft, const std::vector<int>& free,
                                 const VectorXd& between) {
  std::vector<DayBlock> out;
  for (const HealthyDay& day : draft.days) out.push_back(block_of(day, draft.model, free, between));
  return out;
}

/// Estimates the parameters of the robot from all days but `left_out`.
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

/// Returns the draft with the noise of its rows, from the residual of days and robot: `robot` has the
/// parameters of the one for each day. `order`: of the autoregression; variance and autoregression are then
/// estimated in turn.
DayDraft with_noise(DayDraft draft, const std::vector<VectorXd>& robot, int order) {
  BalanceModel& m = draft.model;
  std::vector<LogResidual> left;
  for (std::size_t d = 0; d < draft.days.size(); ++d) {
    const HealthyDay& day = draft.days[d];
    left.push_back({&day.rows, left_over(day, robot[d]), {}, rows_near_change(day, m)});
  }
  for (JointNoise& joint : m.noise.joint) joint.filter = VectorXd::Ones(1);
  for (int round = 0; round < (order > 0 ? kNoiseRounds : 1); ++round) {
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
  }
  return draft;
}

/// Fit of robot and all days together: the robot's parameters free, the effects random.
struct MixedEffects {
  DayDraft draft;           ///< with the estimated parameters and effects
  Eigen::VectorXd moments;  ///< second moments of the effects about their mean, posterior variance included
};

/// Best linear unbiased prediction (equation (7) of docs/how-it-works.md; Henderson 1950), given the variance
/// `between` the days. The normal matrix is an arrow: the robot, and a block for each day, which is
/// eliminated.
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

/// The robot estimated from all days but one, with noise and nonlinear terms from all days.
struct RobotWithoutDay {
  Eigen::VectorXd theta;
  Eigen::VectorXd moments;  ///< as in MixedEffects
};

/// Returns one such robot for each day, from the same normal equations.
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

Eigen::VectorXd variance_of(const BalanceModel& model, const EffectStd& std) {
  const DayLayout day = day_layout(model);
  Eigen::VectorXd out = Eigen::VectorXd::Constant(day.count(), std.inertia * std.inertia);
  out[day.delay()] = std.delay * std.delay;
  for (int d = 0; d < day.drives; ++d) out[day.drive_friction(d)] = std.friction * std.friction;
  for (int j = 0; j < model.joints(); ++j) {
    const double offset = std.offset * model.torque_rms[j];
    out[day.friction(j)] = std.friction * std.friction;
    out[day.friction_slope(j)] = std.slope * std.slope;
    out[day.gain(j)] = std.gain * std.gain;
    out[day.offset(j)] = offset * offset;
    out[day.friction_width(j)] = std.width * std.width;
    out[day.direction(j)] = std.direction * std.direction;
    out[day.load(j)] = std.load * std.load;
    out[day.viscous_excess(j)] = std.viscous * std.viscous;
  }
  return out;
}

/// Excludes gain and offset of a prismatic joint along gravity: they are not separable from a mass.
Eigen::VectorXd without_doubles(const BalanceModel& model, Eigen::VectorXd variance) {
  const DayLayout day = day_layout(model);
  for (int j = 0; j < model.joints(); ++j)
    if (carries_weight(model.rigid, j)) variance[day.gain(j)] = variance[day.offset(j)] = kNoEffect;
  return variance;
}

/// Returns the variance between the days from the second moments of their effects: at least that of kLeast,
/// and none for an effect that is not distinguishable from another.
Eigen::VectorXd variance_between_days(const BalanceModel& model, const Eigen::VectorXd& moments) {
  return without_doubles(model, moments.cwiseMax(variance_of(model, kLeast)));
}

/// Prior variance of an unseen day: twice the variance between the days, plus that of kUnseen.
Eigen::VectorXd prior_of_a_day(const BalanceModel& model, const Eigen::VectorXd& between) {
  return without_doubles(model, kUnseenDays * between + variance_of(model, kUnseen));
}

/// Returns the draft with the noise of rows that the robot has not seen: of each day beside the robot of the
/// other days and the effects of the day. `without` are these robots. Rows that are a part of the fit have
/// less noise, since few or short logs leave the many terms of a robot much freedom. A single day keeps the
/// noise of its own fit.
DayDraft with_unseen_noise(DayDraft draft, const std::vector<BalanceModel>& without) {
  if (draft.days.size() < 2) return draft;
  const std::vector<int> free = free_columns(draft);
  std::vector<VectorXd> robot;
  for (std::size_t d = 0; d < draft.days.size(); ++d) {
    HealthyDay& day = draft.days[d];
    robot.push_back(without[d].theta);
    day.effect = block_of(day, draft.model, free, without[d].day_variance).effect(robot.back()(free));
  }
  return with_noise(std::move(draft), robot, kFilterOrder);
}

}  // namespace

FittedDays fit_days(std::span<LogSource* const> logs, const ParameterSpace& space,
                    TorqueTiming torque_between_samples, const std::vector<double>& drive_limit) {
  DayDraft draft = first_draft(logs, space, torque_between_samples, drive_limit);
  Eigen::VectorXd between = without_doubles(draft.model, variance_of(draft.model, kFirst));
  for (int round = 0; round < kFitRounds; ++round) {
    draft = with_terms_of_round(std::move(draft), round);
    if (round == 0) draft = with_first_piece(std::move(draft));
    draft = with_piece_paths(std::move(draft), round < kFinePathsFrom);
    const std::vector<VectorXd> robot(draft.days.size(), draft.model.theta);
    draft = with_noise(std::move(draft), robot, round < kWhiteRounds ? 0 : kFilterOrder);
    MixedEffects fit = fit_mixed_effects(std::move(draft), between);
    draft = std::move(fit.draft);
    between = variance_between_days(draft.model, fit.moments);
  }
  draft.model = with_compliance(std::move(draft.model));
  FittedDays out;
  for (const RobotWithoutDay& robot : fit_without_each_day(draft, between)) {
    BalanceModel& m = out.without.emplace_back(draft.model);
    m.theta = robot.theta;
    m.day_variance = prior_of_a_day(m, variance_between_days(m, robot.moments));
  }
  draft = with_unseen_noise(std::move(draft), out.without);
  for (BalanceModel& m : out.without) m.noise = draft.model.noise;
  for (HealthyDay& day : draft.days) out.pieces.push_back({day.rows.time_s, std::move(day.path)});
  draft.model.day_variance = prior_of_a_day(draft.model, between);
  out.model = std::move(draft.model);
  return out;
}

}  // namespace faultline
