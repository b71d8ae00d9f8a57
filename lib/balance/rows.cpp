// SPDX-License-Identifier: MIT
#include "lib/balance/rows.hpp"

#include <limits>

#include "lib/balance/regressor.hpp"
#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What holds between neighbouring samples.
struct Intervals {
  MatrixXd velocity;     ///< of each sample
  MatrixXd torque;       ///< intervals x joints
  MatrixXd torque_step;  ///< from the sample before to the one after
  MatrixXd q;            ///< at the middle
  MatrixXd link_speed;   ///< smoothed, behind the spring
};

MatrixXd middle(const MatrixXd& values) {
  const Index n = values.rows() - 1;
  return 0.5 * (values.topRows(n) + values.bottomRows(n));
}

/// The torque that acts in each interval, and its step over the interval.
void read_torque(const MatrixXd& tau, const RowSetting& setting, Intervals& out) {
  const Index n = tau.rows() - 1;
  out.torque.resize(n, tau.cols());
  out.torque_step.resize(n, tau.cols());
  for (Index k = 0; k < n; ++k) {
    const Index a = std::clamp<Index>(k + setting.torque_lag, 0, n);
    const Index b = std::clamp<Index>(k + 1 + setting.torque_lag, 0, n);
    out.torque.row(k) = setting.torque_is_held ? tau.row(a).eval() : (0.5 * (tau.row(a) + tau.row(b))).eval();
    out.torque_step.row(k) = tau.row(b) - tau.row(a);
  }
}

Intervals intervals(const UniformLog& log, const RowSetting& setting) {
  Intervals out;
  out.velocity = fused_velocity(log, setting);
  read_torque(log.tau, setting, out);
  out.q = middle(log.q);
  const VectorXd friction = gaussian_kernel(setting.friction_s, setting.period_s);
  out.link_speed = middle(smooth(out.velocity, friction));
  for (int j = 0; j < setting.joints(); ++j)
    if (setting.compliance.size() > 0 && setting.compliance[j] > 0.0)
      out.link_speed.col(j) -=
          setting.compliance[j] * gradient(smooth(out.torque.col(j), friction), setting.period_s);
  return out;
}

int reach_samples(const RowSetting& setting, const VectorXd& kernel) {
  const Index friction = gaussian_kernel(setting.friction_s, setting.period_s).size();
  return static_cast<int>(kernel.size() / 2 + friction / 2 + 1);
}

/// Rows of the coarse grid: interval `first` + k * decimation is the middle of row k.
struct CoarseGrid {
  int first = 0, step = 1, count = 0;
};

CoarseGrid coarse_grid(int samples, const RowSetting& setting, const VectorXd& kernel) {
  CoarseGrid grid;
  grid.first = reach_samples(setting, kernel);
  grid.step = setting.decimation;
  const int last = samples - 1 - grid.first;  // one behind
  grid.count = last > grid.first ? (last - grid.first + grid.step - 1) / grid.step : 0;
  return grid;
}

JointVector<double> row_of(const MatrixXd& values, Index k) { return values.row(k).transpose(); }

/// Columns of the base parameters: change of momentum over the interval less the force of motion and gravity.
void add_base_columns(const UniformLog& log, const RowSetting& setting, const RigidColumns& rigid,
                      const MatrixXd& velocity, std::vector<MatrixXd>& column) {
  const int n = rigid.joints(), links = n * kLinkParameters;
  LinkRegressor momentum, force;
  MatrixXd before_p, before_f;
  for (int k = 0; k < log.rows(); ++k) {
    const JointVector<double> dq = row_of(velocity, k);
    const LinkFrames frames = link_frames(rigid.chain, row_of(log.q, k));
    momentum_regressor(frames, dq, momentum);
    force_regressor(frames, dq, force);
    MatrixXd p = momentum * rigid.lift.topRows(links), f = force * rigid.lift.topRows(links);
    for (int j = 0; j < n; ++j) p.row(j) += dq[j] * rigid.lift.row(links + j);
    if (k > 0)
      for (int j = 0; j < n; ++j)
        column[j].row(k - 1).head(rigid.base()) =
            (p.row(j) - before_p.row(j)) / setting.period_s - 0.5 * (f.row(j) + before_f.row(j));
    before_p.swap(p);
    before_f.swap(f);
  }
}

VectorXd saturated(const VectorXd& speed, double width) {
  return speed.unaryExpr([width](double v) { return elementary::tanh(v / width); });
}

/// -M(q) d2(torque)/dt2 of each spring, at the rows.
void add_spring_columns(const RowSetting& setting, const RigidColumns& rigid, const VectorXd& theta,
                        const Intervals& at, const VectorXd& kernel, const CoarseGrid& grid,
                        BalanceRows& rows) {
  const ColumnLayout layout = layout_of(rigid, setting);
  const Chain<double> chain = chain_of(rigid, theta);
  const MatrixXd torque = smooth(at.torque, kernel);
  MatrixXd bend(torque.rows(), torque.cols());
  for (int i = 0; i < bend.cols(); ++i)
    bend.col(i) = gradient(gradient(torque.col(i), setting.period_s), setting.period_s);
  for (int m = 0; m < grid.count; ++m) {
    const int k = grid.first + m * grid.step;
    const JointMatrix<double> inertia = inertia_matrix(chain, row_of(at.q, k));
    for (int j = 0; j < rigid.joints(); ++j)
      for (int i = 0; i < rigid.joints(); ++i)
        rows.column[j](m, layout.spring(i)) = -inertia(j, i) * bend(k, i);
  }
}

void add_ripple_columns(const RowSetting& setting, const ColumnLayout& layout, const Intervals& at,
                        std::vector<MatrixXd>& column) {
  for (int r = 0; r < layout.ripples; ++r) {
    const auto [j, rate] = setting.ripples[r];
    for (Index k = 0; k < at.q.rows(); ++k) {
      const auto [s, c] = elementary::sin_cos(rate * at.q(k, j));
      const double tau = at.torque(k, j);
      column[j].row(k).segment<4>(layout.ripple(r)) << s * tau, c * tau, s, c;
    }
  }
}

/// Rows whose kernel crosses a sample that the log lacks.
std::vector<bool> crossing_lost(const std::vector<bool>& lost, const CoarseGrid& grid, int reach) {
  std::vector<int> before(lost.size() + 1, 0);
  for (std::size_t k = 0; k < lost.size(); ++k) before[k + 1] = before[k] + lost[k];
  std::vector<bool> out(grid.count);
  const int rows = static_cast<int>(lost.size());
  for (int m = 0; m < grid.count; ++m) {
    const int k = grid.first + m * grid.step;
    out[m] = before[std::min(k + reach + 2, rows)] > before[std::max(k - reach, 0)];
  }
  return out;
}

[[noreturn]] void too_short(const UniformLog& log, const RowSetting& setting) {
  throw Error(ErrorCode::input, "",
              "the log lasts " + std::to_string(log.rows() * setting.period_s) +
                  " s, which is shorter than the kernel that smooths it; record longer logs");
}

/// What rows and residuals of one log share.
struct RowFrame {
  VectorXd kernel;
  CoarseGrid grid;
  Intervals at;
};

RowFrame row_frame(const UniformLog& log, const RowSetting& setting) {
  const VectorXd kernel = gaussian_kernel(setting.kernel_s, setting.period_s);
  const CoarseGrid grid = coarse_grid(log.rows(), setting, kernel);
  if (grid.count < 2) too_short(log, setting);
  return {kernel, grid, intervals(log, setting)};
}

}  // namespace

double reach_s(const RowSetting& setting) {
  return setting.period_s * reach_samples(setting, gaussian_kernel(setting.kernel_s, setting.period_s));
}

double velocity_reach_s(const RowSetting& setting, double share) {
  if (setting.velocity_is_difference || setting.fusion.size() == 0) return 0.0;
  const double decay = setting.fusion.maxCoeff();
  if (decay >= 1.0) return std::numeric_limits<double>::infinity();
  return decay > 0.0 ? setting.period_s * elementary::log(share) / elementary::log(decay) : 0.0;
}

Chain<double> chain_of(const RigidColumns& rigid, const VectorXd& theta) {
  Chain<double> chain = rigid.chain;
  const int n = rigid.joints();
  const VectorXd numbers = rigid.lift * theta.head(rigid.base());
  chain.rotor_inertia.resize(n, 0.0);
  for (int i = 0; i < n; ++i) {
    chain.links[i] = link_from(numbers.segment<kLinkParameters>(i * kLinkParameters));
    chain.rotor_inertia[i] = numbers[n * kLinkParameters + i];
  }
  return chain;
}

MatrixXd fused_velocity(const UniformLog& log, const RowSetting& setting) {
  MatrixXd out(log.q.rows(), log.q.cols());
  for (int j = 0; j < log.joints(); ++j) {
    out.col(j) = gradient(log.q.col(j), setting.period_s);
    if (setting.velocity_is_difference || log.dq.rows() == 0) continue;
    const double decay = setting.fusion[j];
    out.col(j) = two_sided_exponential(out.col(j), decay) + log.dq.col(j) -
                 two_sided_exponential(log.dq.col(j), decay);
  }
  return out;
}

BalanceRows balance_rows(const UniformLog& log, const RowSetting& setting, const RigidColumns& rigid,
                         const VectorXd& theta) {
  const auto [kernel, grid, at] = row_frame(log, setting);
  const ColumnLayout layout = layout_of(rigid, setting);
  const int n = rigid.joints();
  std::vector<MatrixXd> fine(n, MatrixXd::Zero(log.rows() - 1, layout.count()));
  add_base_columns(log, setting, rigid, at.velocity, fine);
  for (int j = 0; j < n; ++j) {
    fine[j].col(layout.viscous(j)) = at.link_speed.col(j);
    fine[j].col(layout.coulomb(j)) = saturated(at.link_speed.col(j), setting.friction_width[j]);
    fine[j].col(layout.offset(j)).setOnes();
    fine[j].col(layout.delay(j)) = -at.torque_step.col(j);
  }
  add_ripple_columns(setting, layout, at, fine);
  BalanceRows rows;
  const auto at_rows = [&](const MatrixXd& values) {
    return smooth_at(values, kernel, grid.first, grid.step, grid.count);
  };
  for (int j = 0; j < n; ++j) rows.column.push_back(at_rows(fine[j]));
  rows.torque = at_rows(at.torque);
  rows.step_square =
      smooth_at(at.torque_step.cwiseAbs2(), kernel.cwiseAbs2(), grid.first, grid.step, grid.count);
  rows.q = at_rows(at.q);
  rows.dq = at_rows(at.link_speed);
  rows.time_s.resize(grid.count);
  rows.sample.resize(grid.count);
  for (int m = 0; m < grid.count; ++m) {
    rows.sample[m] = grid.first + m * grid.step;
    rows.time_s[m] = log.time_s(rows.sample[m] + 0.5);
  }
  rows.lost = crossing_lost(log.lost, grid, grid.first);
  if (theta.size() > 0) add_spring_columns(setting, rigid, theta, at, kernel, grid, rows);
  return rows;
}

MatrixXd residual_of(const UniformLog& log, const RowSetting& setting, const RigidColumns& rigid,
                     const VectorXd& theta, int first_row) {
  const auto [kernel, grid, at] = row_frame(log, setting);
  const ColumnLayout layout = layout_of(rigid, setting);
  const int n = rigid.joints(), from = first_row * grid.step;  // first sample within reach of the first row
  const Chain<double> chain = chain_of(rigid, theta);
  const JointVector<double> rotor = Eigen::Map<const VectorXd>(chain.rotor_inertia.data(), n);
  MatrixXd left = at.torque;
  MomentumAndForce before;
  for (int k = from; k < log.rows(); ++k) {
    const JointVector<double> dq = row_of(at.velocity, k);
    MomentumAndForce now = momentum_and_force(link_frames(chain, row_of(log.q, k)), chain.links, dq);
    now.momentum += rotor.cwiseProduct(dq);
    if (k > from)
      left.row(k - 1) -=
          ((now.momentum - before.momentum) / setting.period_s - 0.5 * (now.force + before.force))
              .transpose();
    before = std::move(now);
  }
  for (int j = 0; j < n; ++j) {
    left.col(j) -= theta[layout.viscous(j)] * at.link_speed.col(j) +
                   theta[layout.coulomb(j)] * saturated(at.link_speed.col(j), setting.friction_width[j]);
    left.col(j).array() -= theta[layout.offset(j)];
    left.col(j) += theta[layout.delay(j)] * at.torque_step.col(j);
  }
  for (int r = 0; r < layout.ripples; ++r) {
    const auto [j, rate] = setting.ripples[r];
    const auto t = theta.segment<4>(layout.ripple(r));
    for (Index k = 0; k < left.rows(); ++k) {
      const auto [s, c] = elementary::sin_cos(rate * at.q(k, j));
      left(k, j) -= (t[0] * s + t[1] * c) * at.torque(k, j) + t[2] * s + t[3] * c;
    }
  }
  return smooth_at(left, kernel, grid.first + from, grid.step, grid.count - first_row);
}

}  // namespace faultline
