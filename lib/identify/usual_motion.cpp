// SPDX-License-Identifier: MIT
#include "lib/identify/usual_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "lib/core/error.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kFewestUsualRows = 50;  // of all logs: fewer do not show the usual motion
// Usual sizes, as shares of quantities of the healthy logs.
constexpr double kBiasShare = 0.02;         // of the joint's range: some degrees
constexpr double kDriftShare = 0.02;        // of the joint's range, in a second
constexpr double kFrictionShare = 0.05;     // of the joint's rms torque: added friction at least
constexpr double kExternalShare = 0.5;      // of the joint's largest torque: a collision
constexpr double kPayloadShare = 0.5;       // of the mass that the robot carries
constexpr double kUsualCollision_s = 0.05;  // of a collision: times the largest torque, the usual impulse
// Avoid division by zero, if a robot has no length or a joint never moved.
constexpr double kLeastReach_m2 = 1e-6;
constexpr double kLeastVelocity = 1e-6;  // rad/s or m/s

/// Sums over the rows of one joint.
struct JointSums {
  double q_low = std::numeric_limits<double>::infinity(), q_high = -q_low;
  double dq_squared = 0.0, tau_squared = 0.0, tau_largest = 0.0;
  long long dq_count = 0, tau_count = 0;

  double velocity_rms() const { return root_mean(dq_squared, dq_count); }
  double torque_rms() const { return root_mean(tau_squared, tau_count); }
  static double root_mean(double sum, long long count) {
    return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
  }
};

void add_joint(const Log& rows, int j, JointSums& sums, double& last_q, double& last_t) {
  for (int k = 0; k < rows.rows(); ++k) {
    const double t = rows.time[k], q = rows.q[j][k], dq = rows.dq.empty() ? kNaN : rows.dq[j][k],
                 tau = rows.tau.empty() ? 0.0 : rows.tau[j][k];
    const bool derived = !std::isfinite(dq) && std::isfinite(q) && std::isfinite(last_q) && t > last_t;
    const double velocity = derived ? (q - last_q) / (t - last_t) : dq;
    if (std::isfinite(q)) {
      sums.q_low = std::min(sums.q_low, q);
      sums.q_high = std::max(sums.q_high, q);
    }
    if (std::isfinite(velocity)) {
      sums.dq_squared += velocity * velocity;
      ++sums.dq_count;
    }
    if (std::isfinite(tau)) {
      sums.tau_squared += tau * tau;
      sums.tau_largest = std::max(sums.tau_largest, std::abs(tau));
      ++sums.tau_count;
    }
    last_q = q;
    last_t = t;
  }
}

std::vector<JointSums> sums_of(std::span<LogSource* const> logs, int joints) {
  std::vector<JointSums> sums(joints);
  long long rows = 0;
  for (LogSource* log : logs) {
    log->rewind();
    std::vector<double> last_q(joints, kNaN), last_t(joints, 0.0);
    for (Log segment; log->next(segment);) {
      rows += segment.rows();
      for (int j = 0; j < joints; ++j) add_joint(segment, j, sums[j], last_q[j], last_t[j]);
    }
  }
  if (rows < kFewestUsualRows)
    throw Error(ErrorCode::input, "healthy logs",
                "have " + std::to_string(rows) + " usable rows; at least " +
                    std::to_string(kFewestUsualRows) + " are needed");
  return sums;
}

/// Returns the mass that a payload is compared with: that of a prismatic joint, else that which the first
/// joint turns, both in the middle of the range.
double carried_mass(const UsualMotion& usual, const Chain& chain) {
  JointVector middle(usual.joints());
  for (int j = 0; j < usual.joints(); ++j) middle[j] = 0.5 * (usual.q_low[j] + usual.q_high[j]);
  const JointMatrix inertia = inertia_matrix(chain, middle);
  for (int j = usual.joints() - 1; j >= 0; --j)
    if (chain.geometry[j].kind == AxisKind::prismatic) return inertia(j, j);
  double reach = 0.0;
  for (const double l : chain.length) reach += l;
  for (int j = 1; j < usual.joints(); ++j) reach += chain.geometry[j].offset.norm();
  return inertia(0, 0) / std::max(reach * reach, kLeastReach_m2);
}

UsualSizes usual_sizes(const UsualMotion& usual, const std::vector<JointSums>& sums, const Chain& chain) {
  UsualSizes out;
  for (int j = 0; j < usual.joints(); ++j) {
    const double range = usual.q_high[j] - usual.q_low[j], torque = sums[j].torque_rms(),
                 velocity = std::max(sums[j].velocity_rms(), kLeastVelocity);
    const Friction& friction = chain.friction[j];
    out.bias.push_back(kBiasShare * range);
    out.drift.push_back(kDriftShare * range);
    out.viscous_increase.push_back(std::max(std::abs(friction.viscous), kFrictionShare * torque / velocity));
    out.coulomb_increase.push_back(std::max(std::abs(friction.coulomb), kFrictionShare * torque));
    out.external_torque.push_back(kExternalShare * usual.torque_scale[j]);
  }
  out.payload = kPayloadShare * carried_mass(usual, chain);
  return out;
}

}  // namespace

UsualMotion usual_motion(std::span<LogSource* const> logs, const Chain& chain) {
  const std::vector<JointSums> sums = sums_of(logs, chain.joints());
  UsualMotion out;
  for (const JointSums& joint : sums) {
    out.q_low.push_back(joint.q_low);
    out.q_high.push_back(joint.q_high);
    out.velocity_scale.push_back(joint.velocity_rms());
    out.torque_scale.push_back(joint.tau_largest);
  }
  out.sizes = usual_sizes(out, sums, chain);
  return out;
}

double feature_scale(const UsualMotion& usual, SizeMeasure measure, int j) {
  switch (measure) {
    case SizeMeasure::torque_share:
      return 1.0;
    case SizeMeasure::length:
      return usual.sizes.bias[j];
    case SizeMeasure::length_per_s:
      return usual.sizes.drift[j];
    case SizeMeasure::viscous_friction:
      return usual.sizes.viscous_increase[j];
    case SizeMeasure::coulomb_friction:
      return usual.sizes.coulomb_increase[j];
    case SizeMeasure::mass:
      return usual.sizes.payload;
    case SizeMeasure::torque:
      return usual.sizes.external_torque[j];
    case SizeMeasure::impulse:
      return usual_size(usual, measure, j);
  }
  return 1.0;
}

double usual_size(const UsualMotion& usual, SizeMeasure measure, int j) {
  switch (measure) {
    case SizeMeasure::length:
    case SizeMeasure::length_per_s:
      return usual.q_high[j] - usual.q_low[j];
    case SizeMeasure::mass:
      return usual.sizes.payload / kPayloadShare;
    case SizeMeasure::torque:
      return usual.torque_scale[j];
    case SizeMeasure::impulse:
      return usual.torque_scale[j] * kUsualCollision_s;
    case SizeMeasure::torque_share:
    case SizeMeasure::viscous_friction:
    case SizeMeasure::coulomb_friction:
      break;
  }
  return feature_scale(usual, measure, j);
}

}  // namespace faultline
