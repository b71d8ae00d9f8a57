// SPDX-License-Identifier: MIT
#pragma once

#include "lib/evidence/motion_model.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {

/// A filter's model of `robot` with round numbers and nothing learned: at once there, and known to the
/// reader.
inline MotionModel hand_made_model(const Robot& robot) {
  MotionModel model;
  model.chain = robot.chain;
  const auto n = static_cast<std::size_t>(robot.joints());
  model.noise.step_share = 0.0;
  model.noise.torque_share = 0.02;
  model.noise.rest_share = 0.3;
  for (std::size_t j = 0; j < n; ++j) {
    const bool turns = robot.chain.geometry[j].kind == AxisKind::revolute;
    model.noise.floor.push_back(0.2);
    model.q_std.push_back(turns ? 1e-4 : 2e-5);
    model.dq_std.push_back(turns ? 5e-3 : 1e-3);
    model.q_low.push_back(turns ? -2.0 : -0.35);
    model.q_high.push_back(turns ? 2.0 : 0.05);
    model.velocity_scale.push_back(turns ? 1.0 : 0.2);
    model.torque_scale.push_back(turns ? 20.0 / static_cast<double>(j + 1) : 40.0);
    model.inertia_scale.push_back(turns ? 1.0 : 2.5);
    model.priors.bias.push_back(turns ? 0.08 : 0.008);
    model.priors.drift.push_back(turns ? 0.08 : 0.008);
    model.priors.viscous_increase.push_back(2.0 + static_cast<double>(j));
    model.priors.coulomb_increase.push_back(3.0 + static_cast<double>(j));
    model.priors.external_torque.push_back(0.5 * model.torque_scale[j]);
  }
  model.repeat_share.assign(n, 0.0);
  model.longest_repeat.assign(n, 0);
  model.priors.payload = 1.25;
  return model;
}

}  // namespace faultline
