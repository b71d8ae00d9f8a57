// SPDX-License-Identifier: MIT
#include "lib/simulate/plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/core/random.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/runge_kutta.hpp"

namespace faultline {
namespace {

/// Largest rate x step that Runge-Kutta of fourth order follows with a few per cent (it is stable to 2.78).
constexpr double kRateTimesStep = 1.0;

/// Steps a stiff friction may ask for within max_step_s.
constexpr double kMostSubSteps = 10.0;

/// Adds `mass` at the end of the last link.
void add_payload(Chain<double>& chain, double mass) {
  const int last = chain.joints() - 1;
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& along = chain.geometry[last].direction;
  if (chain.geometry[last].kind == AxisKind::revolute)
    tip = chain.length[last] * (along.isZero() ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : along);
  const LinkInertia<double> body = general_body(mass, tip, Eigen::Matrix3d::Zero());
  chain.links[last].mass += body.mass;
  chain.links[last].first_moment += body.first_moment;
  chain.links[last].inertia += body.inertia;
}

/// Largest diagonal of M^-1 for each joint over some postures.
JointVector<double> mobility(const FastDynamics& dynamics) {
  const int n = dynamics.joints();
  Random random(1);
  JointVector<double> most = JointVector<double>::Zero(n), q(n), bias;
  const JointVector<double> rest = JointVector<double>::Zero(n);
  JointMatrix<double> inertia;
  for (int k = 0; k < 16; ++k) {
    for (int i = 0; i < n; ++i) q[i] = k ? random.uniform(-3.0, 3.0) : 0.0;
    dynamics.inertia_and_bias(q, rest, inertia, bias);
    const JointMatrix<double> inverse = inertia.inverse();
    most = most.cwiseMax(inverse.diagonal());
  }
  return most;
}

}  // namespace

Plant::Plant(const Robot& robot, const JointStops& stops, const std::vector<FaultEvent>& faults,
             double max_step_s)
    : healthy_(robot.chain), faults_(faults), max_step_(max_step_s), dynamics_(robot.chain) {
  const int n = robot.joints();
  for (const FaultEvent& fault : faults_) {
    changes_.push_back(fault.onset_s);
    if (std::isfinite(fault.end_s)) changes_.push_back(fault.end_s);
  }
  std::sort(changes_.begin(), changes_.end());
  if (!stops.low.empty() || !stops.high.empty()) {
    if (static_cast<int>(stops.low.size()) != n || static_cast<int>(stops.high.size()) != n)
      throw Error(ErrorCode::usage, "limits.stop_low, stop_high",
                  fmt::format("expected {} numbers in each", n));
    JointMatrix<double> inertia;
    JointVector<double> bias;
    const JointVector<double> zero = JointVector<double>::Zero(n);
    dynamics_.inertia_and_bias(zero, zero, inertia, bias);
    stop_low_ = Eigen::Map<const Eigen::VectorXd>(stops.low.data(), n);
    stop_high_ = Eigen::Map<const Eigen::VectorXd>(stops.high.data(), n);
    stop_stiffness_ = stops.frequency_rad_s * stops.frequency_rad_s * inertia.diagonal();
    stop_damping_ = 2.0 * stops.damping * stops.frequency_rad_s * inertia.diagonal();
  }
  q = dq = JointVector<double>::Zero(n);
  enter(-1.0);
}

/// The steps this moment's mechanics allow, near rest and sliding; raises friction widths that would ask for
/// more than kMostSubSteps.
void Plant::choose_steps(Chain<double>& chain) {
  const JointVector<double> most = mobility(FastDynamics(chain));
  double sliding = 0.0, near_rest = 0.0;
  for (int i = 0; i < chain.joints(); ++i) {
    Friction<double>& f = chain.friction[i];
    f.width = std::max(f.width, most[i] * f.coulomb * max_step_ / (kRateTimesStep * kMostSubSteps));
    sliding = std::max(sliding, most[i] * f.viscous);
    if (stop_low_.size() > 0) sliding = std::max(sliding, std::sqrt(most[i] * stop_stiffness_[i]));
    near_rest = std::max(near_rest, most[i] * (f.viscous + f.coulomb / f.width));
  }
  const auto step_for = [&](double rate) {
    return rate > 0.0 ? std::min(max_step_, kRateTimesStep / rate) : max_step_;
  };
  sliding_step_ = step_for(sliding);
  step_ = std::min(sliding_step_, step_for(near_rest));
}

/// The longest step that is safe from the present state, in which the joints accelerate with `ddq`: friction
/// is stiff only where a velocity may pass near zero within the step.
double Plant::safe_step(const JointVector<double>& ddq) const {
  if (step_ == sliding_step_) return step_;
  for (int i = 0; i < dq.size(); ++i) {
    const Friction<double>& f = dynamics_.chain().friction[i];
    if (f.coulomb != 0.0 && std::abs(dq[i]) < 8.0 * f.width + 2.0 * sliding_step_ * std::abs(ddq[i]))
      return step_;
  }
  return sliding_step_;
}

/// The mechanics of the moment `now`: which faults act, and the velocity that a joint just locked has lost.
void Plant::enter(double now) {
  const int n = healthy_.joints();
  Chain<double> chain = healthy_;
  const unsigned was_locked = locked_;
  gain_ = JointVector<double>::Ones(n);
  external_ = JointVector<double>::Zero(n);
  locked_ = 0;
  altered_ = false;
  for (const FaultEvent& fault : faults_) {
    if (now < fault.onset_s || now >= fault.end_s) continue;
    const int i = fault.joint - 1;
    altered_ = true;
    const MachineFault change = machine_fault(fault);
    gain_[i] *= change.torque_gain;
    external_[i] += change.external_torque;
    chain.friction[i].coulomb += change.coulomb;
    chain.friction[i].viscous += change.viscous;
    if (change.locks) locked_ |= 1u << i;
    if (change.tip_mass != 0.0) add_payload(chain, change.tip_mass);
  }
  choose_steps(chain);
  dynamics_ = FastDynamics(chain);
  if (locked_ & ~was_locked) impact();
}

/// A joint locks: it stops at once, and the impulse of the lock changes the other joints' velocities so that
/// their momenta stay.
void Plant::impact() {
  const int n = healthy_.joints();
  JointMatrix<double> inertia;
  JointVector<double> bias;
  dynamics_.inertia_and_bias(q, dq, inertia, bias);
  JointVector<double> momenta = inertia * dq;
  solve_small(n, inertia.data(), momenta.data(), locked_);
  dq = momenta;
}

void Plant::advance(double from, double to, const JointVector<double>& tau) {
  double now = from;
  while (next_change_ < changes_.size() && changes_[next_change_] <= to) {
    const double change = std::max(changes_[next_change_++], now);
    integrate(change - now, tau);
    now = change;
    enter(now);
  }
  integrate(to - now, tau);
}

void Plant::accelerate(const JointVector<double>& at, const JointVector<double>& rate,
                       const JointVector<double>& tau, JointVector<double>& out) const {
  const bool stops = stop_low_.size() > 0;
  if (!altered_ && !stops) return dynamics_.acceleration(at, rate, tau, out);
  const int n = dynamics_.joints();
  JointVector<double> net(n);
  for (int i = 0; i < n; ++i) {
    net[i] = gain_[i] * tau[i] + external_[i];
    if (!stops) continue;
    const double beyond = at[i] > stop_high_[i] ? at[i] - stop_high_[i] : std::min(at[i] - stop_low_[i], 0.0);
    if (beyond != 0.0) {  // a stop pushes, it never pulls
      const double push = stop_stiffness_[i] * beyond + stop_damping_[i] * rate[i];
      net[i] -= beyond > 0.0 ? std::max(push, 0.0) : std::min(push, 0.0);
    }
  }
  dynamics_.acceleration(at, rate, net, out, locked_);
}

void Plant::integrate(double length, const JointVector<double>& tau) {
  const auto acceleration = [&](double, const JointVector<double>& at, const JointVector<double>& rate,
                                JointVector<double>& out) { accelerate(at, rate, tau, out); };
  JointVector<double> a1(dq.size());
  while (length > 1e-12) {
    accelerate(q, dq, tau, a1);
    const double h = length / std::max(1.0, std::ceil(length / safe_step(a1) - 1e-9));
    runge_kutta_step(h, a1, acceleration, q, dq);
    length -= h;
  }
}

}  // namespace faultline
