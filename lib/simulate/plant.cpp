// SPDX-License-Identifier: MIT
#include "lib/simulate/plant.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/core/random.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/runge_kutta.hpp"
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
