// SPDX-License-Identifier: MIT
// The motion of a plant with compliant gears: motors and links each have a state of their own.
#include <algorithm>
#include <cmath>

#include "lib/robot/runge_kutta.hpp"
#include "lib/simulate/plant.hpp"

namespace faultline {
namespace {

constexpr int kRestIterations = 100;  // each scales the error by weight's slope / spring stiffness

}  // namespace

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
