// SPDX-License-Identifier: MIT
#include "lib/identify/days/fit_days.hpp"

#include <algorithm>
#include <cmath>

#include "lib/balance/regress.hpp"
#include "lib/balance/smoothing.hpp"
#include "lib/balance/work_piece.hpp"
#include "lib/core/error.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/days/draft_rows.hpp"
#include "lib/identify/days/payload_columns.hpp"
#include "lib/identify/days/ripple_search.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kHighRate_s = 0.005, kKernelAtHighRate_s = 0.012, kKernel_s = 0.016;
constexpr double kDelayStd = 0.3;  // samples
constexpr int kRotorsFrom = 5;     // round from which rotors are looked for
constexpr double kTinyRidge = 1e-9;
constexpr double kNoEffect = 1e-10;  // variance of an effect that is not told from another
constexpr double kFast = 0.999;      // quantile of a joint's speed
constexpr int kPieceRows = 20;       // over which a mass is estimated
constexpr double kPieceShare = 0.1;  // of the tip's mass that a work piece has at least
constexpr double kGravity = 9.81;

/// One healthy log while the robot is fitted.
struct Day {
  UniformLog log;
  BalanceRows rows;
  std::vector<MatrixXd> day_column;  ///< by joint
  MatrixXd tip;                      ///< torque of 1 kg at the tip: rows x joints
  PiecePath path;
  MatrixXd piece;   ///< torque of the work piece: rows x joints
  VectorXd effect;  ///< of the day
  MatrixXd std;     ///< of the rows
};

struct Draft {
  BalanceModel model;
  std::vector<Day> days;
  std::vector<bool> used;  ///< columns that are free
};

MatrixXd effect_torque(const Day& day) {
  MatrixXd out(day.rows.rows(), day.rows.joints());
  for (int j = 0; j < out.cols(); ++j) out.col(j) = day.day_column[j] * day.effect;
  return out;
}

MatrixXd left_over(const Day& day, const VectorXd& theta) {
  return day.rows.torque - torque_of(day.rows, theta) - day.piece - effect_torque(day);
}

int reach_of_change(const RowSetting& setting) {
  return static_cast<int>(std::ceil(3.0 * setting.kernel_s / setting.row_s()));
}

void make_rows(Draft& draft) {
  for (Day& day : draft.days) {
    const BalanceModel& m = draft.model;
    day.rows = balance_rows(day.log, m.setting, m.rigid, m.theta);
    if (day.piece.size() == 0) day.piece.setZero(day.rows.rows(), m.joints());
  }
}

void make_day_columns(Draft& draft) {
  const BalanceModel& m = draft.model;
  for (Day& day : draft.days) {
    day.day_column = day_columns(day.rows, m.layout(), m.theta);
    if (day.effect.size() == 0) day.effect.setZero(day_layout(m.rigid).count());
    day.tip = payload_torque(day.rows, m.payload, m.joints() - 1);
  }
}

/// Variance of the effects before any day was looked at.
VectorXd first_variance(const BalanceModel& model) {
  const DayLayout day = day_layout(model.rigid);
  VectorXd v = VectorXd::Constant(day.count(), 3e-6);
  for (int j = 0; j < model.joints(); ++j) {
    v[day.friction(j)] = 0.01;
    v[day.friction_slope(j)] = 1e-3;
    v[day.gain(j)] = carries_weight(model.rigid, j) ? kNoEffect : 3e-6;
    v[day.offset(j)] = carries_weight(model.rigid, j) ? kNoEffect : std::pow(0.002 * model.torque_rms[j], 2);
  }
  return v;
}

/// What few days cannot show: the least normal variance of each effect.
VectorXd least_variance(const BalanceModel& model) {
  const DayLayout day = day_layout(model.rigid);
  VectorXd v = VectorXd::Constant(day.count(), 1e-7);
  for (int j = 0; j < model.joints(); ++j) {
    v[day.friction(j)] = 1e-4;
    v[day.friction_slope(j)] = 1e-5;
    v[day.offset(j)] = std::pow(2e-4 * model.torque_rms[j], 2);
  }
  return v;
}

/// Prior of a day that was never seen: twice the variance between the days, and what few days cannot show.
VectorXd prior_of_a_day(const BalanceModel& model, const VectorXd& between) {
  const DayLayout day = day_layout(model.rigid);
  VectorXd v = 2.0 * between;
  v.array() += 1e-6;
  for (int j = 0; j < model.joints(); ++j) {
    v[day.friction(j)] += std::pow(0.05, 2);
    v[day.friction_slope(j)] += std::pow(0.03, 2);
    v[day.offset(j)] += std::pow(0.001 * model.torque_rms[j], 2);
    if (carries_weight(model.rigid, j)) v[day.gain(j)] = v[day.offset(j)] = kNoEffect;
  }
  return v;
}

void fit_noise(Draft& draft, int order) {
  BalanceModel& m = draft.model;
  std::vector<LeftOver> left;
  const int reach = reach_of_change(m.setting);
  for (Day& day : draft.days) {
    LeftOver l;
    l.rows = &day.rows;
    l.torque = left_over(day, m.theta);
    if (m.piece_kg > 0.0) l.not_counted = near_change(day.path, reach);
    left.push_back(std::move(l));
  }
  fit_variance(left, m.setting, m.noise);
  for (std::size_t d = 0; d < left.size(); ++d) {
    Day& day = draft.days[d];
    day.std = row_std(day.rows, m.setting, m.noise, VectorXd::Ones(m.joints()));
    for (int k = 0; k < day.rows.rows() && m.piece_kg > 0.0; ++k)
      if (left[d].not_counted[k])
        day.std.row(k) = (day.std.row(k).array().square() + std::pow(m.piece_kg * kGravity, 2)).sqrt();
    left[d].std = day.std;
  }
  fit_filter(left, order, m.noise);
}

MatrixXd whitened(const std::vector<MatrixXd>& column, const Day& day, const RowNoise& noise) {
  const Eigen::Index rows = day.rows.rows();
  MatrixXd out(rows * day.rows.joints(), column.front().cols());
  for (int j = 0; j < day.rows.joints(); ++j)
    out.middleRows(j * rows, rows) = whiten(column[j], day.std.col(j), noise.joint[j]);
  return out;
}

VectorXd whitened(const MatrixXd& torque, const Day& day, const RowNoise& noise) {
  const Eigen::Index rows = day.rows.rows();
  VectorXd out(rows * torque.cols());
  for (int j = 0; j < torque.cols(); ++j)
    out.segment(j * rows, rows) = whiten(torque.col(j), day.std.col(j), noise.joint[j]);
  return out;
}

/// Robot and effects of all days together, given their variance `between`; returns the second moments of the
/// effects about their mean.
VectorXd fit_robot_and_days(Draft& draft, const VectorXd& between) {
  BalanceModel& m = draft.model;
  std::vector<int> free;
  for (std::size_t p = 0; p < draft.used.size(); ++p)
    if (draft.used[p]) free.push_back(static_cast<int>(p));
  const int count = static_cast<int>(free.size()), effects = static_cast<int>(between.size());
  MatrixXd a = MatrixXd::Zero(count, count);
  VectorXd b = VectorXd::Zero(count);
  const ColumnLayout layout = m.layout();
  for (int i = 0; i < count; ++i)
    if (free[i] >= layout.delay(0) && free[i] < layout.spring(0)) a(i, i) += 1.0 / (kDelayStd * kDelayStd);
  struct Block {
    Eigen::LLT<MatrixXd> factor;
    MatrixXd cross;
    VectorXd vector;
  };
  std::vector<Block> blocks;
  for (Day& day : draft.days) {
    const MatrixXd y = whitened(day.rows.column, day, m.noise)(Eigen::all, free);
    const MatrixXd w = whitened(day.day_column, day, m.noise);
    const VectorXd r = whitened(day.rows.torque - day.piece, day, m.noise);
    MatrixXd own = w.transpose() * w;
    own.diagonal() += between.cwiseInverse();
    Block block{Eigen::LLT<MatrixXd>(own), w.transpose() * y, w.transpose() * r};
    a += y.transpose() * y - block.cross.transpose() * block.factor.solve(block.cross);
    b += y.transpose() * r - block.cross.transpose() * block.factor.solve(block.vector);
    blocks.push_back(std::move(block));
  }
  a.diagonal() *= 1.0 + kTinyRidge;
  a.diagonal().array() += 1e-12;
  const VectorXd theta = a.ldlt().solve(b);
  m.theta.setZero();
  m.theta(free) = theta;
  VectorXd mean = VectorXd::Zero(effects), square = VectorXd::Zero(effects);
  for (std::size_t d = 0; d < blocks.size(); ++d) {
    const Block& block = blocks[d];
    VectorXd& effect = draft.days[d].effect;
    effect = block.factor.solve(block.vector - block.cross * theta);
    mean += effect;
    square += effect.cwiseAbs2() + block.factor.solve(MatrixXd::Identity(effects, effects)).diagonal();
  }
  mean /= static_cast<double>(blocks.size());
  for (Day& day : draft.days) day.effect -= mean;
  return square / static_cast<double>(blocks.size()) - mean.cwiseAbs2();
}

/// Mass of a work piece that comes and goes, from masses at the tip that some rows each ask for; 0 when none
/// stands out. `without` receives the mean mass in the rows without it.
double first_piece(const Draft& draft, double* without) {
  const BalanceModel& m = draft.model;
  std::vector<double> step, ratio, low;
  for (const Day& day : draft.days) {
    const MatrixXd r = day.rows.torque - torque_of(day.rows, m.theta);
    const int windows = day.rows.rows() / kPieceRows;
    std::vector<double> mass;
    for (int w = 0; w < windows; ++w) {
      double num = 0.0, den = 0.0;
      for (int j = 0; j < m.joints(); ++j) {
        if (!carries_weight(m.rigid, j)) continue;
        const auto x = day.tip.col(j).segment(w * kPieceRows, kPieceRows);
        num += x.dot(r.col(j).segment(w * kPieceRows, kPieceRows));
        den += x.squaredNorm();
      }
      if (den > 0.0) mass.push_back(num / den);
    }
    if (mass.size() < 6) return 0.0;
    std::sort(mass.begin(), mass.end());
    const Eigen::Map<const VectorXd> sorted(mass.data(), static_cast<Eigen::Index>(mass.size()));
    const auto spread = [](const auto& v) { return (v.array() - v.mean()).square().sum(); };
    double least = 0.0;
    int split = 0;
    for (int k = 2; k + 2 < sorted.size(); ++k) {
      const double sum = spread(sorted.head(k)) + spread(sorted.tail(sorted.size() - k));
      if (split == 0 || sum < least) least = sum, split = k;
    }
    low.push_back(upper_median({mass.begin(), mass.begin() + split}));
    step.push_back(upper_median({mass.begin() + split, mass.end()}) - low.back());
    ratio.push_back(step.back() / std::sqrt(least / static_cast<double>(mass.size()) + 1e-12));
  }
  const Eigen::Map<const VectorXd> steps(step.data(), static_cast<Eigen::Index>(step.size()));
  const double usual = upper_median(step),
               scatter = std::sqrt((steps.array() - steps.mean()).square().mean());
  double carried = 0.0, unit = 0.0;
  for (const Day& day : draft.days) {
    const MatrixXd torque = torque_of(day.rows, m.theta);
    for (int j = 0; j < m.joints(); ++j) {
      if (!carries_weight(m.rigid, j)) continue;
      carried += torque.col(j).dot(day.tip.col(j));
      unit += day.tip.col(j).squaredNorm();
    }
  }
  const double tip_mass = unit > 0.0 ? carried / unit : 0.0;
  *without = upper_median(low);
  const bool stands_out =
      upper_median(ratio) > 1.5 && scatter < 0.5 * usual && usual > kPieceShare * std::abs(tip_mass);
  return stands_out ? usual : 0.0;
}

/// Paths of the work piece in each day, and its mass.
void fit_pieces(Draft& draft, int round) {
  BalanceModel& m = draft.model;
  if (m.piece_kg <= 0.0) return;
  std::vector<double> size;
  std::vector<MatrixXd> residual;
  for (const Day& day : draft.days) {
    residual.push_back(day.rows.torque - torque_of(day.rows, m.theta) - effect_torque(day));
    for (int k = 0; k < residual.back().rows(); ++k)
      size.push_back(std::abs(residual.back()(k, m.joints() - 1)));
  }
  const double robust = 1.4826 * upper_median(std::move(size));
  const double step = m.piece_kg * kGravity,
               std = round > 3 ? std::max(0.3 * robust, 0.02 * step) : 0.25 * step;
  double num = 0.0, den = 0.0;
  for (std::size_t d = 0; d < draft.days.size(); ++d) {
    Day& day = draft.days[d];
    MatrixXd deviation = MatrixXd::Constant(day.rows.rows(), m.joints(), 1e9);
    for (int j = 0; j < m.joints(); ++j)
      if (carries_weight(m.rigid, j)) deviation.col(j).setConstant(std);
    day.path = piece_path(residual[d], m.piece_kg * day.tip, deviation);
    for (int k = 0; k < day.rows.rows(); ++k) {
      if (day.path[k] == 0) continue;
      for (int j = 0; j < m.joints(); ++j) {
        if (!carries_weight(m.rigid, j)) continue;
        num += day.tip(k, j) * residual[d](k, j);
        den += day.tip(k, j) * day.tip(k, j);
      }
    }
  }
  for (Day& day : draft.days)
    for (int k = 0; k < day.rows.rows(); ++k)
      day.piece.row(k) = day.path[k] != 0 ? (m.piece_kg * day.tip.row(k)).eval() : 0.0 * day.tip.row(k);
  if (den > 0.0) m.piece_kg = num / den;
}

/// Searches the friction width of each joint again, day effects and the work piece taken away.
void refine_widths(Draft& draft) {
  BalanceModel& m = draft.model;
  const ColumnLayout layout = m.layout();
  const int reach = reach_of_change(m.setting);
  for (int j = 0; j < m.joints(); ++j) {
    double least = -1.0, best = m.setting.friction_width[j];
    for (const double factor : {.6, .75, .9, 1., 1.12, 1.3, 1.6}) {
      const double width = factor * m.setting.friction_width[j];
      double sum = 0.0;
      for (const Day& day : draft.days) {
        const std::vector<bool> out =
            m.piece_kg > 0.0 ? near_change(day.path, reach) : std::vector<bool>(day.rows.rows(), false);
        std::vector<int> rows;
        for (int k = 0; k < day.rows.rows(); ++k)
          if (!out[k] && !day.rows.lost[k]) rows.push_back(k);
        const VectorXd r = left_over(day, m.theta).col(j)(rows), v = day.rows.dq.col(j)(rows);
        const auto saturated = [&](double w) {
          return v.unaryExpr([w](double x) { return std::tanh(x / w); });
        };
        const VectorXd y = r + m.theta[layout.coulomb(j)] * saturated(m.setting.friction_width[j]);
        MatrixXd x(v.size(), 3);
        x << v, saturated(width), VectorXd::Ones(v.size());
        const MatrixXd xx = x.transpose() * x + 1e-12 * MatrixXd::Identity(3, 3);
        const VectorXd xy = x.transpose() * y;
        sum += y.squaredNorm() - xy.dot(xx.ldlt().solve(xy));
      }
      if (least < 0.0 || sum < least) least = sum, best = width;
    }
    m.setting.friction_width[j] = best;
  }
}

void take_compliance(BalanceModel& m) {
  for (int j = 0; j < m.joints(); ++j) {
    const double k = m.theta[m.layout().spring(j)];
    m.setting.compliance[j] = k > 1e-5 ? k : 0.0;
  }
}

void add_ripples(Draft& draft) {
  BalanceModel& m = draft.model;
  std::vector<LeftOver> left;
  for (const Day& day : draft.days) {
    LeftOver l;
    l.rows = &day.rows;
    l.torque = left_over(day, m.theta);
    if (m.piece_kg > 0.0) l.not_counted = near_change(day.path, reach_of_change(m.setting));
    left.push_back(std::move(l));
  }
  m.setting.ripples = find_ripples_in_rows(left, m.setting, m.q_high - m.q_low);
  const VectorXd before = m.theta;
  m.theta.setZero(m.layout().count());
  m.theta.head(before.size()) = before;
  draft.used.resize(m.theta.size(), true);
}

/// Ranges, speeds and noise of the healthy logs.
void take_looks(const std::vector<Day>& days, BalanceModel& m) {
  const int n = m.joints();
  std::vector<VectorXd> q, dq;
  m.q_low = VectorXd::Constant(n, 1e300);
  m.q_high = -m.q_low;
  m.top_speed = m.torque_rms = m.repeat_share = VectorXd::Zero(n);
  m.longest_repeat = Eigen::VectorXi::Zero(n);
  double rows = 0.0;
  for (const Day& day : days) {
    q.push_back(sample_noise(day.log.q));
    dq.push_back(sample_noise(day.log.dq.rows() > 0 ? day.log.dq : day.log.q));
    m.q_low = m.q_low.cwiseMin(day.log.q.colwise().minCoeff().transpose());
    m.q_high = m.q_high.cwiseMax(day.log.q.colwise().maxCoeff().transpose());
    m.torque_rms += day.log.tau.cwiseAbs2().colwise().sum().transpose();
    rows += day.log.rows();
    const MatrixXd speed = fused_velocity(day.log, m.setting).cwiseAbs();
    for (int j = 0; j < n; ++j) {
      std::vector<double> v(speed.col(j).data(), speed.col(j).data() + speed.rows());
      m.top_speed[j] = std::max(m.top_speed[j], upper_quantile(std::move(v), kFast));
      int run = 0, same = 0;
      for (int k = 1; k < day.log.rows(); ++k) {
        run = day.log.q(k, j) == day.log.q(k - 1, j) ? run + 1 : 0;
        same += run > 0;
        m.longest_repeat[j] = std::max(m.longest_repeat[j], run);
      }
      m.repeat_share[j] +=
          static_cast<double>(same) / (day.log.rows() - 1) / static_cast<double>(days.size());
    }
  }
  m.repeat_share = m.repeat_share.cwiseMax(1e-3).cwiseMin(0.999);
  m.torque_rms = (m.torque_rms / rows).cwiseSqrt();
  const auto medians = [&](const std::vector<VectorXd>& all) {
    VectorXd out(n);
    for (int j = 0; j < n; ++j) {
      std::vector<double> v;
      for (const VectorXd& x : all) v.push_back(x[j]);
      out[j] = upper_median(std::move(v));
    }
    return out;
  };
  m.q_noise = medians(q);
  m.dq_noise = medians(dq);
}

RigidColumns rigid_columns(const ParameterSpace& space) { return {space.chain, space.lift}; }

}  // namespace

BalanceModel fit_days(std::span<LogSource* const> logs, const ParameterSpace& space,
                      const DayFitOptions& options) {
  Draft draft;
  BalanceModel& m = draft.model;
  std::vector<double> periods;
  for (LogSource* log : logs) {
    log->rewind();
    const Log all = read_all(*log);
    for (int k = 1; k < all.rows(); ++k) periods.push_back(all.time[k] - all.time[k - 1]);
  }
  if (periods.empty()) throw Error(ErrorCode::input, "", "there are no logs to learn from");
  const double period = std::round(upper_median(std::move(periods)) * 1e6) * 1e-6;
  std::vector<UniformLog> uniform;
  for (LogSource* log : logs) {
    log->rewind();
    uniform.push_back(uniform_log(*log, period));
  }
  m.rigid = rigid_columns(space);
  m.payload = payload_columns(space);
  const double kernel = options.kernel_s > 0.0 ? options.kernel_s
                        : period < kHighRate_s ? kKernelAtHighRate_s
                                               : kKernel_s;
  m.setting = draft_setting(uniform, kernel, options.row_s);
  m.setting.torque_is_held = options.torque_is_held;
  m.setting = with_chosen_lag_and_widths(uniform, m.rigid, m.setting);
  for (UniformLog& log : uniform) draft.days.push_back({.log = std::move(log)});
  take_looks(draft.days, m);

  make_rows(draft);
  draft.used = rigid_columns_used(m.rigid, m.layout());
  std::vector<BalanceRows> rows;
  for (const Day& day : draft.days) rows.push_back(day.rows);
  m.theta = plain_fit(rows, m.layout(), draft.used, m.torque_rms);
  for (int j = 0; j < m.joints() && options.springs; ++j)
    if (m.rigid.chain.geometry[j].kind == AxisKind::revolute) draft.used[m.layout().spring(j)] = true;
  VectorXd between = first_variance(m);
  std::vector<bool> negative(draft.used.size(), false);
  for (int round = 0; round < options.rounds; ++round) {
    if (round == 3 || round == 6) refine_widths(draft);
    if (round == 4 && options.ripples) add_ripples(draft);
    if (round >= 2 && options.springs) take_compliance(m);
    for (int p = 0; p < m.rigid.base(); ++p) {
      if (!is_rotor(m.rigid, p)) continue;
      negative[p] = negative[p] || m.theta[p] < 0.0;
      draft.used[p] = round >= kRotorsFrom && !negative[p];
    }
    if (round <= 4 || round == 6) make_rows(draft);
    make_day_columns(draft);
    if (round == 0 && options.pieces) {
      double without = 0.0;
      m.piece_kg = first_piece(draft, &without);
      if (m.piece_kg > 0.0) m.theta.head(m.rigid.base()) += without * m.payload.col(m.joints() - 1);
    }
    fit_pieces(draft, round);
    fit_noise(draft, options.filter_order);
    between = fit_robot_and_days(draft, between).cwiseMax(least_variance(m));
    for (int j = 0; j < m.joints(); ++j)
      if (const DayLayout day = day_layout(m.rigid); carries_weight(m.rigid, j))
        between[day.gain(j)] = between[day.offset(j)] = kNoEffect;
  }
  m.day_variance = prior_of_a_day(m, between);
  return std::move(draft.model);
}

}  // namespace faultline
