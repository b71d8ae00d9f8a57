// SPDX-License-Identifier: MIT
#include "lib/evidence/usual_motion.hpp"

#include <algorithm>
#include <string>

#include "lib/core/error.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr int kFewestRows = 50;        // fewer say nothing of noise and range
constexpr double kFloorShare = 0.001;  // of the largest torque, where matching starts
constexpr double kLeastFloor = 1e-9;   // N m or N, of joints without torque

/// M_jj in the middle of the range.
std::vector<double> inertia_scale(const MotionModel& model) {
  JointVector<double> middle(model.joints());
  for (int j = 0; j < model.joints(); ++j) middle[j] = 0.5 * (model.q_low[j] + model.q_high[j]);
  const JointMatrix<double> inertia = inertia_matrix(model.chain, middle);
  std::vector<double> diagonal;
  for (int j = 0; j < model.joints(); ++j) diagonal.push_back(inertia(j, j));
  return diagonal;
}

}  // namespace

MotionModel usual_motion(std::span<LogSource* const> logs, const IdentifiedMotion& identified,
                         const SizePriorOptions& priors) {
  MotionModel model;
  model.chain = identified.chain;
  model.torque_phi = identified.torque_phi;
  model.q_std = identified.q_std;
  model.dq_std = identified.dq_std;
  const HealthyStatistics healthy = healthy_statistics(logs, identified.chain.joints());
  if (healthy.rows < kFewestRows)
    throw Error(ErrorCode::input, "healthy logs",
                "hold " + std::to_string(healthy.rows) + " usable rows; at least " +
                    std::to_string(kFewestRows) + " are needed");
  model.q_low = healthy.q_low;
  model.q_high = healthy.q_high;
  model.velocity_scale = healthy.velocity_rms;
  model.torque_scale = healthy.torque_largest;
  model.torque_jump = healthy.torque_jump;
  model.repeat_share = healthy.repeat_share;
  model.longest_repeat = healthy.longest_repeat;
  for (const double torque : healthy.torque_largest)
    model.noise.floor.push_back(std::max(kFloorShare * torque, kLeastFloor));
  if (identified.torque_is_held) model.noise.step_share = 0.0;
  model.inertia_scale = inertia_scale(model);
  model.priors = size_priors(model, healthy, priors);
  return model;
}

}  // namespace faultline
