// SPDX-License-Identifier: MIT
#include "lib/simulate/plant.hpp"

#include <algorithm>
#include <cmath>

#include "lib/robot/runge_kutta.hpp"

// The motion of a plant; with compliant gears, motors and links each have a state of their own.

namespace faultline {
namespace {

constexpr int kRestIterations = 100;  // each scales the error by weight's slope / spring stiffness

}  // namespace

/// Returns the longest safe step from a state in which the drives have the velocity `rate` and the
/// acceleration `ddq`: friction is stiff only if a velocity may pass near zero within the step.
double Plant::safe_step(const JointVector& rate, const JointVector& ddq) const {
  if (step_ == sliding_step_) return step_;
  const std::vector<Friction>& friction = (geared_ ? geared_->drives : dynamics_).chain().friction;
  for (int i = 0; i < rate.size(); ++i) {
    const Friction& f = friction[i];
    if (f.coulomb != 0.0 && std::abs(rate[i]) < 8.0 * f.width + 2.0 * sliding_step_ * std::abs(ddq[i]))
      return step_;
  }
  return sliding_step_;
}

void Plant::advance(double from, double to, const JointVector& tau) {
  extra_friction_.set_time(0.5 * (from + to));
  const auto move_on = [&](double length) {
    return geared_ ? integrate_geared(length, tau) : integrate(length, tau);
  };
  double now = from;
  while (next_change_ < changes_.size() && changes_[next_change_] <= to) {
    const double change = std::max(changes_[next_change_++], now);
    move_on(change - now);
    now = change;
    enter(now);
  }
  move_on(to - now);
}

/// Returns the torque of the end stop, which pushes but never pulls.
double Plant::stop_torque(int joint, double at, double rate) const {
  const bool high = at > stop_high_[joint];
  const double beyond = at - (high ? stop_high_[joint] : stop_low_[joint]);
  const double push = stop_stiffness_[joint] * beyond + stop_damping_[joint] * rate;
  return high ? std::max(push, 0.0) : std::min(push, 0.0);
}

void Plant::accelerate(const JointVector& at, const JointVector& rate, const JointVector& tau,
                       JointVector& out) const {
  const bool stops = stop_low_.size() > 0, extra = extra_friction_.any();
  if (!altered_ && !stops && !extra) return dynamics_.acceleration(at, rate, tau, out);
  const int n = dynamics_.joints();
  JointVector net(n);
  for (int i = 0; i < n; ++i) {
    net[i] = gain_[i] * tau[i] + external_[i];
    if (extra) net[i] -= extra_friction_.torque(i, rate[i], dynamics_.chain().friction[i]);
    if (stops && is_beyond_stop(i, at[i])) net[i] -= stop_torque(i, at[i], rate[i]);
  }
  dynamics_.acceleration(at, rate, net, out, locked_);
}

void Plant::integrate(double length, const JointVector& tau) {
  const auto acceleration = [&](double, const JointVector& at, const JointVector& rate, JointVector& out) {
    accelerate(at, rate, tau, out);
  };
  JointVector a1(dq.size());
  while (length > 1e-12) {
    accelerate(q, dq, tau, a1);
    const double h = length / std::max(1.0, std::ceil(length / safe_step(dq, a1) - 1e-9));
    runge_kutta_step(h, a1, acceleration, q, dq);
    length -= h;
  }
}

void Plant::start(const JointVector& position, const JointVector& speed) {
  q = position;
  dq = speed;
  if (!geared_) return;
  geared_->q = position;
  geared_->dq = speed;
  const JointVector rest = JointVector::Zero(q.size());
  JointMatrix inertia;
  JointVector weight;
  for (int k = 0; k < kRestIterations; ++k) {
    dynamics_.inertia_and_bias(q, rest, inertia, weight);
    for (int i = 0; i < q.size(); ++i)
      if (geared_->gears.has_spring(i)) q[i] = position[i] - geared_->gears.twist_under(i, weight[i]);
  }
}

/// A joint with a spring: J th'' = acting torque - drag - gear torque for its motor, and the gear torque
/// drives its link. A rigid joint: as without gears; its motor moves with its link.
void Plant::accelerate_geared(const BothSides& at, const BothSides& rate, const JointVector& tau,
                              BothSides& out) const {
  const int n = dynamics_.joints();
  const Gears& gears = geared_->gears;
  const JointVector link = at.head(n), link_rate = rate.head(n), motor = at.tail(n),
                    motor_rate = rate.tail(n);
  const std::vector<Friction>& friction = geared_->drives.chain().friction;
  JointVector arrives(n), drag(n), net(n), ddq(n);
  for (int i = 0; i < n; ++i)
    arrives[i] = gain_[i] * tau[i] + drive_offset_[i] - extra_friction_.torque(i, motor_rate[i], friction[i]);
  geared_->drives.drag(motor, motor_rate, arrives, drag);
  for (int i = 0; i < n; ++i) {
    const bool spring = gears.has_spring(i);
    const double gear =
        spring ? gears.torque(i, motor[i] - link[i], motor_rate[i] - link_rate[i]) : arrives[i];
    net[i] = gear + external_[i];
    if (stop_low_.size() > 0 && is_beyond_stop(i, link[i])) net[i] -= stop_torque(i, link[i], link_rate[i]);
    if (spring) out[n + i] = locked_ >> i & 1u ? 0.0 : (arrives[i] - drag[i] - gear) / gears.motor_inertia(i);
  }
  dynamics_.acceleration(link, link_rate, net, ddq, locked_ & ~springs());
  out.head(n) = ddq;
  for (int i = 0; i < n; ++i)
    if (!gears.has_spring(i)) out[n + i] = ddq[i];
}

void Plant::integrate_geared(double length, const JointVector& tau) {
  const auto n = q.size();
  const auto acceleration = [&](double, const BothSides& at, const BothSides& rate, BothSides& out) {
    accelerate_geared(at, rate, tau, out);
  };
  BothSides at(2 * n), rate(2 * n), a1(2 * n);
  at << q, geared_->q;
  rate << dq, geared_->dq;
  while (length > 1e-12) {
    accelerate_geared(at, rate, tau, a1);
    const double h = length / std::max(1.0, std::ceil(length / safe_step(rate.tail(n), a1.tail(n)) - 1e-9));
    runge_kutta_step(h, a1, acceleration, at, rate);
    length -= h;
  }
  q = at.head(n);
  dq = rate.head(n);
  geared_->q = at.tail(n);
  geared_->dq = rate.tail(n);
}

}  // namespace faultline
