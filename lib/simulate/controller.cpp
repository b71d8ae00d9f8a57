// SPDX-License-Identifier: MIT
#include "lib/simulate/controller.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/simulate/joint_list.hpp"

namespace faultline {
namespace {

Chain nominal_chain(const Robot& robot, const ControllerSpec& spec) {
  Chain chain = spec.nominal ? *spec.nominal : robot.chain;
  if (chain.joints() != robot.joints())
    bad_value("controller.nominal",
              fmt::format("expected a model with {} joints, found {}", robot.joints(), chain.joints()));
  if (spec.mass_error.empty()) return chain;
  check_count(robot.joints(), spec.mass_error, "controller.mass_error");
  for (int i = 0; i < chain.joints(); ++i) {
    const double factor = 1.0 + spec.mass_error[i];
    if (!(factor > 0.0)) bad_value("controller.mass_error", "expected errors above -1 (a share of the mass)");
    chain.links[i].mass *= factor;
    chain.links[i].first_moment *= factor;
    chain.links[i].inertia *= factor;
  }
  return chain;
}

}  // namespace

Controller::Controller(const Robot& robot, const ControllerSpec& spec, double control_period_s)
    : spec_(spec), nominal_(nominal_chain(robot, spec)) {
  if (spec.bandwidth_rad_s < 0.0 || spec.damping < 0.0)
    bad_value("controller", "expected a bandwidth and a damping that are not negative");
  const double w = spec.bandwidth_rad_s > 0.0 ? spec.bandwidth_rad_s : std::min(15.0, 0.4 / control_period_s);
  kp_ = w * w;
  kd_ = 2.0 * spec.damping * w;
  JointMatrix inertia;
  JointVector bias;
  const JointVector zero = JointVector::Zero(robot.joints());
  nominal_.inertia_and_bias(zero, zero, inertia, bias);
  inertia_ = inertia.diagonal();
}

void Controller::torque(const Reference& reference, const JointVector& q, const JointVector& dq,
                        JointVector& tau) const {
  const int n = nominal_.joints();
  const bool full = spec_.kind == ControllerKind::computed_torque;
  JointMatrix inertia;
  JointVector pull(n), rates(n);
  for (int i = 0; i < n; ++i) {
    pull[i] = kp_ * (reference.q[i] - q[i]) + kd_ * (reference.dq[i] - dq[i]);
    if (full) pull[i] += reference.ddq[i];
    rates[i] = full ? dq[i] : 0.0;
  }
  nominal_.inertia_and_bias(q, rates, inertia, tau);
  for (int i = 0; i < n; ++i) {
    if (!full) tau[i] += inertia_[i] * pull[i];
    for (int k = 0; full && k < n; ++k) tau[i] += inertia(i, k) * pull[k];
  }
  if (!full || !spec_.friction_compensation) return;
  nominal_.friction(reference.dq, rates);
  for (int i = 0; i < n; ++i) tau[i] += rates[i];
}

}  // namespace faultline
