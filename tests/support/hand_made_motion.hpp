// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/usual_motion.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {

/// A usual motion of `robot` with round numbers: at once there, and known to the reader.
inline UsualMotion hand_made_motion(const Robot& robot) {
  UsualMotion usual;
  const auto n = static_cast<std::size_t>(robot.joints());
  for (std::size_t j = 0; j < n; ++j) {
    const bool turns = robot.chain.geometry[j].kind == AxisKind::revolute;
    usual.q_low.push_back(turns ? -2.0 : -0.35);
    usual.q_high.push_back(turns ? 2.0 : 0.05);
    usual.velocity_scale.push_back(turns ? 1.0 : 0.2);
    usual.torque_scale.push_back(turns ? 20.0 / static_cast<double>(j + 1) : 40.0);
    usual.sizes.bias.push_back(turns ? 0.08 : 0.008);
    usual.sizes.drift.push_back(turns ? 0.08 : 0.008);
    usual.sizes.viscous_increase.push_back(2.0 + static_cast<double>(j));
    usual.sizes.coulomb_increase.push_back(3.0 + static_cast<double>(j));
    usual.sizes.external_torque.push_back(0.5 * usual.torque_scale[j]);
  }
  usual.sizes.payload = 1.25;
  return usual;
}

}  // namespace faultline
