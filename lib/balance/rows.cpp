// SPDX-License-Identifier: MIT
#include "lib/balance/rows.hpp"

#include <Eigen/SparseCore>

#include "lib/balance/regressor.hpp"
#include "lib/balance/row_frame.hpp"
#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Momentum and force (FastDynamics::momentum_and_force()) by base parameter, with it 1 and all others 0.
class BaseMotion {
 public:
  explicit BaseMotion(const RigidColumns& rigid)
      : rigid_(rigid),
        units_(unit_dynamics(rigid)),
        lift_(rigid.lift.topRows(rigid.joints() * kLinkParameters).sparseView()) {}

  /// Writes both, joints x base each.
  void at(const JointVector& q, const JointVector& dq, MatrixXd& momentum, MatrixXd& force) {
    const int n = rigid_.joints(), links = n * kLinkParameters;
    if (!units_.empty()) {
      momentum.resize(n, rigid_.base());
      force.resize(n, rigid_.base());
      JointVector p, f;
      for (int k = 0; k < rigid_.base(); ++k) {
        units_[k].momentum_and_force(q, dq, p, f);
        momentum.col(k) = p;
        force.col(k) = f;
      }
      return;
    }
    const LinkFrames frames = link_frames(rigid_.chain, q);
    momentum_regressor(frames, dq, link_momentum_);
    force_regressor(frames, dq, link_force_);
    momentum = link_momentum_ * lift_;
    force = link_force_ * lift_;
    for (int j = 0; j < n; ++j) momentum.row(j) += dq[j] * rigid_.lift.row(links + j);
  }

 private:
  const RigidColumns& rigid_;
  std::vector<FastDynamics> units_;   ///< by base parameter; parallel axes only
  Eigen::SparseMatrix<double> lift_;  ///< of the link parameters: most entries are 0
  LinkRegressor link_momentum_, link_force_;
};

/// Returns the columns of the base parameters, by joint: intervals x base. Each is the mean rate of change of
/// the momentum over the interval minus the force of motion and gravity.
std::vector<MatrixXd> base_columns(const UniformLog& log, const RowSetting& setting,
                                   const RigidColumns& rigid, const MatrixXd& velocity) {
  std::vector<MatrixXd> column(rigid.joints(), MatrixXd(log.rows() - 1, rigid.base()));
  BaseMotion motion(rigid);
  MatrixXd p, f, before_p, before_f;
  for (int k = 0; k < log.rows(); ++k) {
    motion.at(row_of(log.q, k), row_of(velocity, k), p, f);
    if (k > 0)
      for (int j = 0; j < rigid.joints(); ++j)
        column[j].row(k - 1) =
            (p.row(j) - before_p.row(j)) / setting.period_s - 0.5 * (f.row(j) + before_f.row(j));
    before_p.swap(p);
    before_f.swap(f);
  }
  return column;
}

/// Writes -M(q) d2(torque)/dt2 of each spring to the columns of the rows.
void add_spring_columns(const RowSetting& setting, const RigidColumns& rigid, const VectorXd& theta,
                        const Intervals& at, const VectorXd& kernel, const CoarseGrid& grid,
                        BalanceRows& rows) {
  const ColumnLayout layout = layout_of(rigid, setting);
  const Chain chain = chain_of(rigid, theta);
  const MatrixXd torque = smooth(at.torque, kernel);
  MatrixXd bend(torque.rows(), torque.cols());
  for (int i = 0; i < bend.cols(); ++i)
    bend.col(i) = gradient(gradient(torque.col(i), setting.period_s), setting.period_s);
  for (int m = 0; m < grid.count; ++m) {
    const int k = grid.first + m * grid.step;
    const JointMatrix inertia = inertia_matrix(chain, row_of(at.q, k));
    for (int j = 0; j < rigid.joints(); ++j)
      for (int i = 0; i < rigid.joints(); ++i)
        rows.column[j](m, layout.spring(i)) = -inertia(j, i) * bend(k, i);
  }
}

/// Returns the four columns of a ripple by interval: sine and cosine times the torque, then alone.
MatrixXd ripple_columns(const RippleRate& ripple, const Intervals& at) {
  MatrixXd out(at.q.rows(), 4);
  for (Index k = 0; k < out.rows(); ++k) {
    const auto [s, c] = elementary::sin_cos(ripple.rate * at.q(k, ripple.joint.index()));
    const double tau = at.torque(k, ripple.joint.index());
    out.row(k) << s * tau, c * tau, s, c;
  }
  return out;
}

/// Returns by row whether its kernel crosses a sample that the log lacks.
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

}  // namespace

Chain chain_of(const RigidColumns& rigid, const VectorXd& theta) {
  Chain chain = rigid.chain;
  const int n = rigid.joints();
  const VectorXd numbers = rigid.lift * theta.head(rigid.base());
  chain.rotor_inertia.resize(n, 0.0);
  for (int i = 0; i < n; ++i) {
    chain.links[i] = link_from(numbers.segment<kLinkParameters>(i * kLinkParameters));
    chain.rotor_inertia[i] = numbers[n * kLinkParameters + i];
  }
  return chain;
}

std::vector<FastDynamics> unit_dynamics(const RigidColumns& rigid) {
  std::vector<FastDynamics> out;
  for (int p = 0; p < rigid.base(); ++p) {
    FastDynamics unit(chain_of(rigid, VectorXd::Unit(rigid.base(), p)));
    if (!unit.planar()) return {};
    out.push_back(std::move(unit));
  }
  return out;
}

BalanceRows balance_rows(const UniformLog& log, const RowSetting& setting, const RigidColumns& rigid,
                         const VectorXd& theta) {
  const RowFrame frame = row_frame(log, setting);
  const auto& [kernel, grid, at] = frame;
  const ColumnLayout layout = layout_of(rigid, setting);
  const int n = rigid.joints();
  const auto at_rows = [&kernel = frame.kernel, &grid = frame.grid](const MatrixXd& values) {
    return smooth_at(values, kernel, grid.first, grid.step, grid.count);
  };
  BalanceRows rows;
  rows.torque = at_rows(at.torque);
  rows.step_square =
      smooth_at(at.torque_step.cwiseAbs2(), kernel.cwiseAbs2(), grid.first, grid.step, grid.count);
  rows.q = at_rows(at.q);
  rows.dq = at_rows(at.link_speed);
  rows.column.assign(n, MatrixXd::Zero(grid.count, layout.count()));
  const std::vector<MatrixXd> base = base_columns(log, setting, rigid, at.velocity);
  for (int j = 0; j < n; ++j) {
    MatrixXd& column = rows.column[j];
    column.leftCols(layout.base) = at_rows(base[j]);
    column.col(layout.viscous(j)) = rows.dq.col(j);
    column.col(layout.coulomb(j)) = at_rows(saturated(at.link_speed.col(j), setting.friction_width[j]));
    column.col(layout.offset(j)).setConstant(kernel.sum());
    column.col(layout.delay(j)) = -at_rows(at.torque_step.col(j));
  }
  for (int d = 0; d < layout.drives; ++d) {
    const CoupledDrive& drive = setting.drives[d];
    const MatrixXd columns = at_rows(drive_columns(drive, at.velocity, at.link_speed, setting.period_s));
    for (int j = 0; j < n; ++j) rows.column[j].middleCols<3>(layout.drive(d)) = drive.along[j] * columns;
  }
  for (int r = 0; r < layout.ripples; ++r)
    rows.column[setting.ripples[r].joint.index()].middleCols<4>(layout.ripple(r)) =
        at_rows(ripple_columns(setting.ripples[r], at));
  rows.time_s.resize(grid.count);
  for (int m = 0; m < grid.count; ++m) rows.time_s[m] = log.time_s(grid.first + m * grid.step + 0.5);
  rows.lost = crossing_lost(log.lost, grid, grid.first);
  if (theta.size() == 0) return rows;
  for (int j = 0; j < n; ++j) {
    MatrixXd& column = rows.column[j];
    const VectorXd carried = column.leftCols(layout.base) * theta.head(layout.base);
    column.col(layout.load(j)) = carried.cwiseAbs().cwiseProduct(column.col(layout.coulomb(j)));
  }
  add_spring_columns(setting, rigid, theta, at, kernel, grid, rows);
  return rows;
}

Eigen::MatrixX2d friction_columns(const UniformLog& log, const RowSetting& setting, int j) {
  const auto [kernel, grid, at] = row_frame(log, setting);
  Eigen::MatrixX2d friction(at.q.rows(), 2);
  friction << at.link_speed.col(j), saturated(at.link_speed.col(j), setting.friction_width[j]);
  return smooth_at(friction, kernel, grid.first, grid.step, grid.count);
}

}  // namespace faultline
