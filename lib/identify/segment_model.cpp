// SPDX-License-Identifier: MIT
#include "lib/identify/segment_model.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr double kDifference = 1e-5;  ///< rad or m, of the slopes with respect to position

Chain<double> direction_chain(const ParameterSpace& space, int base) {
  Chain<double> chain = space.chain;
  chain.rotor_inertia.assign(chain.joints(), 0.0);
  chain.friction.assign(chain.joints(), {});
  for (int i = 0; i < chain.joints(); ++i)
    chain.links[i] = link_from(space.lift.block<kLinkParameters, 1>(i * kLinkParameters, base));
  return chain;
}

JointVector<double> rigid_torque(const FastDynamics& dynamics, const JointVector<double>& q,
                                 const JointVector<double>& dq, const JointVector<double>& ddq) {
  JointMatrix<double> m;
  JointVector<double> bias;
  dynamics.inertia_and_bias(q, dq, m, bias);
  bias.noalias() += m.lazyProduct(ddq);
  return bias;
}

}  // namespace

/// One evaluation of the equations of motion and their slopes.
struct SegmentModel::Workspace {
  JointVector<double> q, dq, ddq;
  JointMatrix<double> inertia;
  Eigen::LDLT<JointMatrix<double>> factor;
  Eigen::MatrixXd by_state, by_parameter;      ///< of ddq: n x 2n, n x free
  Eigen::VectorXd x, stage, slope, sum;        ///< 2n
  Eigen::MatrixXd s, s_stage, s_slope, s_sum;  ///< 2n x (2n + free)
};

SegmentModel::SegmentModel(const ParameterSpace& space, const Eigen::VectorXd& parameters,
                           const std::vector<int>& free, double longest_step_s)
    : space_(space),
      parameters_(parameters),
      free_(free),
      longest_step_s_(longest_step_s),
      dynamics_(chain_from(space, parameters)) {
  for (int p : free_)
    if (p < space.rigid()) directions_.emplace_back(direction_chain(space, p));
}

void SegmentModel::slopes(Workspace& w) const {
  const int n = space_.joints();
  const auto& friction = dynamics_.chain().friction;
  for (int j = 0; j < n; ++j) {
    const bool idle = dynamics_.planar() && space_.chain.geometry[j].kind == AxisKind::prismatic;
    w.by_state.col(j).setZero();
    w.by_state.col(n + j).setZero();
    if (!idle) {
      JointVector<double> up = w.q, down = w.q;
      up[j] += kDifference;
      down[j] -= kDifference;
      w.by_state.col(j) =
          (rigid_torque(dynamics_, down, w.dq, w.ddq) - rigid_torque(dynamics_, up, w.dq, w.ddq)) /
          (2.0 * kDifference);
      up = down = w.dq;  // the torque is quadratic in velocity: a difference over a whole unit is exact
      up[j] += 0.5;
      down[j] -= 0.5;
      w.by_state.col(n + j) =
          rigid_torque(dynamics_, w.q, down, w.ddq) - rigid_torque(dynamics_, w.q, up, w.ddq);
    }
    const Friction<double>& f = friction[j];
    const double bent = std::tanh(w.dq[j] / f.width);
    w.by_state(j, n + j) -= f.viscous + f.coulomb * (1.0 - bent * bent) / f.width;
  }
}

void SegmentModel::derivative(const JointVector<double>& q, const JointVector<double>& dq,
                              const JointVector<double>& tau, const JointVector<double>& tau_step,
                              bool with_sensitivity, Workspace& w) const {
  const int n = space_.joints();
  JointVector<double> bias, friction;
  dynamics_.inertia_and_bias(q, dq, w.inertia, bias);
  dynamics_.friction(dq, friction);
  w.q = q;
  w.dq = dq;
  w.factor.compute(w.inertia);
  w.ddq = w.factor.solve(tau - bias - friction);
  if (!with_sensitivity) return;
  slopes(w);
  std::size_t direction = 0;
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const int p = free_[k];
    auto column = w.by_parameter.col(k);
    column.setZero();
    if (p < space_.rigid()) {
      column = -rigid_torque(directions_[direction++], q, dq, w.ddq);
    } else if (p == space_.timing()) {
      column = tau_step;
    } else {
      const int joint = (p > space_.timing() ? p - space_.timing() - 1 : p - space_.rigid()) % n;
      const Friction<double>& f = dynamics_.chain().friction[joint];
      const double u = dq[joint] / f.width, bent = std::tanh(u);
      column[joint] = p >= space_.log_width(0) ? f.coulomb * (1.0 - bent * bent) * u
                      : p >= space_.offset(0)  ? -1.0
                      : p >= space_.coulomb(0) ? -bent
                                               : -dq[joint];
    }
  }
  for (Eigen::Index c = 0; c < w.by_state.cols(); ++c)
    w.by_state.col(c) = w.factor.solve(w.by_state.col(c)).eval();
  for (Eigen::Index c = 0; c < w.by_parameter.cols(); ++c)
    w.by_parameter.col(c) = w.factor.solve(w.by_parameter.col(c)).eval();
}

void SegmentModel::run(const Excerpt& e, const Eigen::VectorXd& start, bool with_sensitivity,
                       SegmentMotion& motion) const {
  const int n = space_.joints(), rows = e.rows(), width = 2 * n + static_cast<int>(free_.size());
  Workspace w;
  w.by_state.setZero(n, 2 * n);
  w.by_parameter.setZero(n, free_.size());
  w.x = start;
  w.slope.resize(2 * n);
  if (with_sensitivity) {
    w.s.setIdentity(2 * n, width);
    w.s_slope.resize(2 * n, width);
    motion.sensitivity.resize(2 * n * rows, width);
    motion.sensitivity.topRows(2 * n) = w.s;
  }
  motion.state.resize(2 * n, rows);
  motion.state.col(0) = start;
  const double phi = parameters_[space_.timing()];
  const double at[4] = {0.0, 0.5, 0.5, 1.0}, share[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  for (int k = 0; k + 1 < rows; ++k) {
    const double dt = e.time[k + 1] - e.time[k];
    const int pieces = std::max(1, static_cast<int>(std::ceil(dt / longest_step_s_ - 1e-9)));
    const double h = dt / pieces;
    const JointVector<double> tau_step = e.tau.col(k + 1) - e.tau.col(k);
    const JointVector<double> tau = e.tau.col(k) + phi * tau_step;
    for (int i = 0; i < pieces; ++i) {
      w.sum = w.x;
      if (with_sensitivity) w.s_sum = w.s;
      for (int stage = 0; stage < 4; ++stage) {
        w.stage = w.x;
        if (stage > 0) w.stage += h * at[stage] * w.slope;
        derivative(w.stage.head(n), w.stage.tail(n), tau, tau_step, with_sensitivity, w);
        if (with_sensitivity) {
          w.s_stage = w.s;
          if (stage > 0) w.s_stage += h * at[stage] * w.s_slope;
          w.s_slope.topRows(n) = w.s_stage.bottomRows(n);
          w.s_slope.bottomRows(n).noalias() = w.by_state.lazyProduct(w.s_stage);
          w.s_slope.bottomRightCorner(n, w.by_parameter.cols()) += w.by_parameter;
          w.s_sum += h * share[stage] * w.s_slope;
        }
        w.slope << w.stage.tail(n), w.ddq;
        w.sum += h * share[stage] * w.slope;
      }
      w.x = w.sum;
      if (with_sensitivity) std::swap(w.s, w.s_sum);
    }
    motion.state.col(k + 1) = w.x;
    if (with_sensitivity) motion.sensitivity.middleRows(2 * n * (k + 1), 2 * n) = w.s;
  }
}

double stable_step(const Chain<double>& chain, const JointVector<double>& q) {
  const JointMatrix<double> m = inertia_matrix(chain, q);
  const JointMatrix<double> inverse =
      m.ldlt().solve(JointMatrix<double>::Identity(chain.joints(), chain.joints()));
  double rate = 1e-9;
  for (int j = 0; j < chain.joints(); ++j)
    rate = std::max(rate,
                    std::abs(inverse(j, j)) * std::abs(chain.friction[j].coulomb) / chain.friction[j].width);
  return 0.6 / rate;
}

}  // namespace faultline
