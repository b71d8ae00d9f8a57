// SPDX-License-Identifier: MIT
#include "lib/identify/shooting/segment_model.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr double kDifference = 1e-5;     ///< rad or m: step of the derivatives by position
constexpr double kLongestStep_s = 0.01;  ///< of an integration step while no Coulomb friction changes
constexpr double kTurns = 6.0;           ///< widths of the Coulomb friction: at higher speed it is constant

Chain direction_chain(const ParameterSpace& space, int base) {
  Chain chain = space.chain;
  chain.rotor_inertia.assign(chain.joints(), 0.0);
  chain.friction.assign(chain.joints(), {});
  chain.shared_drives.clear();
  for (int i = 0; i < chain.joints(); ++i) {
    chain.links[i] = link_from(space.lift.block<kLinkParameters, 1>(i * kLinkParameters, base));
    chain.rotor_inertia[i] = space.lift(chain.joints() * kLinkParameters + i, base);
  }
  return chain;
}

/// Inverts in place, by Gauss and Jordan; the matrix is positive definite, so no pivoting.
void invert(JointMatrix& m) {
  const Eigen::Index n = m.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    const double pivot = 1.0 / m(k, k);
    m(k, k) = 1.0;
    for (Eigen::Index c = 0; c < n; ++c) m(k, c) *= pivot;
    for (Eigen::Index r = 0; r < n; ++r) {
      if (r == k) continue;
      const double factor = m(r, k);
      m(r, k) = 0.0;
      for (Eigen::Index c = 0; c < n; ++c) m(r, c) -= factor * m(k, c);
    }
  }
}

/// Computes out = a b for an `a` of few rows, column by column: Eigen's products are made for larger ones.
void multiply_small(const double* a, Eigen::Index rows, const Eigen::MatrixXd& b, Eigen::MatrixXd& out) {
  const Eigen::Index inner = b.rows();
  for (Eigen::Index c = 0; c < b.cols(); ++c) {
    double sum[kMaxJoints] = {};
    const double* column = b.data() + c * inner;
    for (Eigen::Index k = 0; k < inner; ++k)
      for (Eigen::Index r = 0; r < rows; ++r) sum[r] += a[k * rows + r] * column[k];
    std::copy_n(sum, rows, out.data() + c * rows);
  }
}

}  // namespace

/// The equations of motion at one state and their derivatives there.
struct SegmentModel::Workspace {
  JointVector q, dq, ddq;
  JointVector carried;  ///< torque after all friction
  JointVector passed;   ///< share of a torque on the drive that is carried on: 1 without load friction
  JointMatrix inverse_inertia;
  Eigen::MatrixXd by_state, by_parameter;  ///< of ddq: n x 2n, n x free
  Eigen::MatrixXd rhs_state, rhs_parameter;
  LinkRegressor regressor;
  Eigen::VectorXd x, stage, slope, sum;  ///< 2n
  Eigen::MatrixXd s, term, next, bend;   ///< 2n x (2n + free); n x the same
};

SegmentModel::SegmentModel(const ParameterSpace& space, const Eigen::VectorXd& parameters,
                           const std::vector<int>& free, double longest_step_s)
    : space_(space),
      parameters_(parameters),
      free_(free),
      longest_step_s_(longest_step_s),
      dynamics_(chain_from(space, parameters)) {
  for (int p : free_) {
    if (p >= space.rigid()) continue;
    if (dynamics_.planar())
      directions_.emplace_back(direction_chain(space, p));
    else
      shares_.push_back(space.lift.col(p).sparseView());
  }
}

void SegmentModel::accelerate(const JointVector& tau, Workspace& w) const {
  JointVector bias, drag;
  dynamics_.inertia_and_bias(w.q, w.dq, w.inverse_inertia, bias);
  dynamics_.drag(w.q, w.dq, tau, drag);
  w.carried = tau - drag;
  invert(w.inverse_inertia);
  w.ddq.noalias() = w.inverse_inertia.lazyProduct(w.carried - bias);
}

void SegmentModel::pass_torque(Workspace& w) const {
  w.passed.setOnes(space_.joints());
  for (int j = 0; j < space_.joints(); ++j)
    w.passed[j] /=
        1.0 + load_friction(dynamics_.chain().friction[j], w.dq[j], 1.0) * std::copysign(1.0, w.carried[j]);
}

/// Adds the derivatives of ripples by position and of shared friction by velocity.
void SegmentModel::add_extra_slopes(Workspace& w) const {
  const int n = space_.joints();
  for (const Ripple& r : dynamics_.chain().ripples) {
    const auto [sine, cosine] = elementary::sin_cos(r.rate * w.q[r.joint.index()]);
    w.rhs_state(r.joint.index(), r.joint.index()) -=
        w.passed[r.joint.index()] * r.rate * (r.sine * cosine - r.cosine * sine);
  }
  for (const SharedDrive& f : dynamics_.chain().shared_drives) {
    const double bent = elementary::tanh(f.speed(w.dq.data()) / f.width);
    const double slope = f.viscous + f.coulomb * (1.0 - bent * bent) / f.width;
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) w.rhs_state(j, n + k) -= w.passed[j] * slope * f.along[j] * f.along[k];
  }
}

void SegmentModel::slopes_by_state(Workspace& w) const {
  const int n = space_.joints();
  for (int j = 0; j < n; ++j) {
    const bool idle = dynamics_.planar() && space_.chain.geometry[j].kind == AxisKind::prismatic;
    w.rhs_state.col(j).setZero();
    w.rhs_state.col(n + j).setZero();
    if (!idle) {
      JointVector up = w.q, down = w.q;
      up[j] += kDifference;
      down[j] -= kDifference;
      w.rhs_state.col(j) =
          (dynamics_.body_torque(down, w.dq, w.ddq) - dynamics_.body_torque(up, w.dq, w.ddq)) /
          (2.0 * kDifference);
      up = down = w.dq;  // the torque is quadratic in velocity: a difference over a whole unit is exact
      up[j] += 0.5;
      down[j] -= 0.5;
      w.rhs_state.col(n + j) =
          dynamics_.body_torque(w.q, down, w.ddq) - dynamics_.body_torque(w.q, up, w.ddq);
    }
    const Friction& f = dynamics_.chain().friction[j];
    const double bent = elementary::tanh(w.dq[j] / f.width);
    const double dry = f.coulomb + f.load * std::abs(w.carried[j]);
    w.rhs_state(j, n + j) -= w.passed[j] * (f.viscous + dry * (1.0 - bent * bent) / f.width);
    if (f.bend == 0.0 && f.skew == 0.0) continue;
    const double wide = elementary::tanh(w.dq[j] / f.bend_width);
    w.rhs_state(j, n + j) -=
        w.passed[j] * (f.bend * (1.0 - wide * wide) / f.bend_width + std::copysign(f.skew, w.dq[j]));
  }
  add_extra_slopes(w);
  multiply_small(w.inverse_inertia.data(), n, w.rhs_state, w.by_state);
}

/// Computes the negative torque of the `direction`-th free base parameter alone.
void SegmentModel::base_slope(std::size_t direction, const Workspace& w,
                              Eigen::Ref<Eigen::VectorXd> slope) const {
  if (dynamics_.planar()) {
    slope = -directions_[direction].body_torque(w.q, w.dq, w.ddq);
    return;
  }
  const Eigen::Index links = static_cast<Eigen::Index>(space_.joints()) * kLinkParameters;
  slope.setZero();
  for (Eigen::SparseVector<double>::InnerIterator it(shares_[direction]); it; ++it)
    if (it.index() < links)
      slope -= it.value() * w.regressor.col(it.index());
    else
      slope[it.index() - links] -= it.value() * w.ddq[it.index() - links];
}

void SegmentModel::slopes_by_parameter(const JointVector& tau_step, Workspace& w) const {
  const int n = space_.joints();
  std::size_t direction = 0;
  w.rhs_parameter.setZero();
  if (!shares_.empty()) torque_regressor(dynamics_.chain(), w.q, w.dq, w.ddq, w.regressor);
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const int p = free_[k];
    auto column = w.rhs_parameter.col(k);
    if (p < space_.rigid()) {
      base_slope(direction++, w, column);
    } else if (p == space_.timing()) {
      column = tau_step;
    } else if (space_.is_extra(p)) {
      column = -extra_torque(dynamics_.chain(), space_.extra_at(p), w.q, w.dq, w.ddq, w.carried);
    } else {
      const int j = space_.joint_of(p).index();
      const Friction& f = dynamics_.chain().friction[j];
      const double u = w.dq[j] / f.width, bent = elementary::tanh(u);
      const double dry = f.coulomb + f.load * std::abs(w.carried[j]);
      column[j] = p >= space_.log_width(0) ? dry * (1.0 - bent * bent) * u
                  : p >= space_.skew(0)    ? -std::abs(w.dq[j])
                  : p >= space_.bend(0)    ? -elementary::tanh(w.dq[j] / f.bend_width)
                  : p >= space_.offset(0)  ? -1.0
                  : p >= space_.coulomb(0) ? -bent
                                           : -w.dq[j];
    }
    if (!space_.is_inertial(p)) column.array() *= w.passed.array();
  }
  multiply_small(w.inverse_inertia.data(), n, w.rhs_parameter, w.by_parameter);
}

/// Advances the sensitivity over one step, with the derivatives of its middle: S' = A S + B is linear with
/// constant coefficients, so four terms of the series of its exponential are used.
void SegmentModel::carry_sensitivity(double h, Workspace& w) const {
  const int n = space_.joints();
  w.next = w.s;
  w.term = w.s;
  for (int order = 1; order <= 4; ++order) {
    multiply_small(w.by_state.data(), n, w.term, w.bend);
    if (order == 1) w.bend.rightCols(w.by_parameter.cols()) += w.by_parameter;
    w.term.topRows(n) = (h / order) * w.term.bottomRows(n);
    w.term.bottomRows(n) = (h / order) * w.bend;
    w.next += w.term;
  }
  std::swap(w.s, w.next);
}

void SegmentModel::step(double h, const JointVector& tau, const JointVector& tau_step, bool with_sensitivity,
                        Workspace& w) const {
  // Runge-Kutta of fourth order: positions of its stages in the step, and their weights.
  constexpr double kAt[4] = {0.0, 0.5, 0.5, 1.0}, kShare[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  const int n = space_.joints();
  w.sum = w.x;
  for (int stage = 0; stage < 4; ++stage) {
    w.stage = w.x;
    if (stage > 0) w.stage += h * kAt[stage] * w.slope;
    w.q = w.stage.head(n);
    w.dq = w.stage.tail(n);
    accelerate(tau, w);
    w.slope.head(n) = w.dq;
    w.slope.tail(n) = w.ddq;
    w.sum += h * kShare[stage] * w.slope;
    if (!with_sensitivity || stage != 2) continue;
    pass_torque(w);
    slopes_by_state(w);
    slopes_by_parameter(tau_step, w);
    carry_sensitivity(h, w);
  }
  w.x = w.sum;
}

/// Returns the number of steps by the smoothed speed of the log, so that it is the same for all parameters.
int SegmentModel::steps(const Excerpt& e, int k) const {
  double longest = kLongestStep_s;
  for (int j = 0; j < space_.joints(); ++j) {
    const double from = e.speed(j, k), to = e.speed(j, k + 1);
    const double slowest = std::min(std::abs(from), std::abs(to)) - 0.25 * std::abs(to - from);
    if (from * to <= 0.0 || slowest < kTurns * space_.chain.friction[j].width) longest = longest_step_s_;
  }
  return std::max(1, static_cast<int>(std::ceil((e.time[k + 1] - e.time[k]) / longest - 1e-9)));
}

void SegmentModel::run(const Excerpt& e, const Eigen::VectorXd& start, bool with_sensitivity,
                       SegmentMotion& motion) const {
  const int n = space_.joints(), rows = e.rows(), free = static_cast<int>(free_.size());
  Workspace w;
  w.by_state.setZero(n, 2 * n);
  w.by_parameter.setZero(n, free);
  w.rhs_state = w.by_state;
  w.rhs_parameter = w.by_parameter;
  w.x = start;
  w.slope.resize(2 * n);
  w.s.setIdentity(2 * n, 2 * n + free);
  w.bend.resize(n, 2 * n + free);
  if (with_sensitivity) motion.sensitivity.resize(2 * n * rows, 2 * n + free);
  if (with_sensitivity) motion.sensitivity.topRows(2 * n) = w.s;
  motion.state.resize(2 * n, rows);
  motion.state.col(0) = start;
  for (int k = 0; k + 1 < rows; ++k) {
    const double dt = e.time[k + 1] - e.time[k];
    const int pieces = steps(e, k);
    const JointVector tau_step = e.tau.col(k + 1) - e.tau.col(k);
    const JointVector tau = e.tau.col(k) + parameters_[space_.timing()] * tau_step;
    for (int i = 0; i < pieces; ++i) step(dt / pieces, tau, tau_step, with_sensitivity, w);
    motion.state.col(k + 1) = w.x;
    if (with_sensitivity) motion.sensitivity.middleRows(2 * n * (k + 1), 2 * n) = w.s;
  }
}

}  // namespace faultline
