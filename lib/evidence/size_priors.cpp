// SPDX-License-Identifier: MIT
#include "lib/evidence/size_priors.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

// Against division by zero where a robot has no length or a joint never moved.
constexpr double kLeastReach_m2 = 1e-6;
constexpr double kLeastVelocity = 1e-6;  // rad/s or m/s

/// A mass that a payload is compared with: what a prismatic joint carries, else what the first joint turns.
double carried_mass(const MotionModel& model) {
  for (int j = model.joints() - 1; j >= 0; --j)
    if (model.chain.geometry[j].kind == AxisKind::prismatic) return model.inertia_scale[j];
  double reach = 0.0;
  for (const double l : model.chain.length) reach += l;
  for (int j = 1; j < model.joints(); ++j) reach += model.chain.geometry[j].offset.norm();
  return model.inertia_scale[0] / std::max(reach * reach, kLeastReach_m2);
}

}  // namespace

SizePriors size_priors(const MotionModel& model, const HealthyStatistics& healthy,
                       const SizePriorOptions& options) {
  SizePriors priors;
  for (int j = 0; j < model.joints(); ++j) {
    const double range = model.q_high[j] - model.q_low[j];
    const double torque = healthy.torque_rms[j], velocity = std::max(healthy.velocity_rms[j], kLeastVelocity);
    const Friction<double>& friction = model.chain.friction[j];
    priors.bias.push_back(options.bias_share * range);
    priors.drift.push_back(options.drift_share * range);
    priors.viscous_increase.push_back(
        std::max(std::abs(friction.viscous), options.friction_share * torque / velocity));
    priors.coulomb_increase.push_back(std::max(std::abs(friction.coulomb), options.friction_share * torque));
    priors.external_torque.push_back(options.external_share * model.torque_scale[j]);
  }
  priors.payload = options.payload_share * carried_mass(model);
  return priors;
}

}  // namespace faultline
