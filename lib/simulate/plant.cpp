// SPDX-License-Identifier: MIT
#include "lib/simulate/plant.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
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
  JointVector<double> a1(dq.size());
  while (length > 1e-12) {
    accelerate(q, dq, tau, a1);
    const double h = length / std::max(1.0, std::ceil(length / safe_step(a1) - 1e-9));
    runge_kutta(h, tau, a1);
    length -= h;
  }
}

void Plant::runge_kutta(double h, const JointVector<double>& tau, const JointVector<double>& a1) {
  const int n = dynamics_.joints();
  JointVector<double> a2(n), a3(n), a4(n), v2(n), v3(n), v4(n), x(n);
  for (int i = 0; i < n; ++i) {
    v2[i] = dq[i] + 0.5 * h * a1[i];
    x[i] = q[i] + 0.5 * h * dq[i];
  }
  accelerate(x, v2, tau, a2);
  for (int i = 0; i < n; ++i) {
    v3[i] = dq[i] + 0.5 * h * a2[i];
    x[i] = q[i] + 0.5 * h * v2[i];
  }
  accelerate(x, v3, tau, a3);
  for (int i = 0; i < n; ++i) {
    v4[i] = dq[i] + h * a3[i];
    x[i] = q[i] + h * v3[i];
  }
  accelerate(x, v4, tau, a4);
  for (int i = 0; i < n; ++i) {
    q[i] += h / 6.0 * (dq[i] + 2.0 * v2[i] + 2.0 * v3[i] + v4[i]);
    dq[i] += h / 6.0 * (a1[i] + 2.0 * a2[i] + 2.0 * a3[i] + a4[i]);
  }
}

}  // namespace faultline
