// SPDX-License-Identifier: MIT
#include "lib/evidence/watch/faulty_robot.hpp"

#include <algorithm>

#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr double kImmovable = 1e7;  // times its usual inertia
constexpr double kCoupled = 1e-6;   // M_ij^2 over M_ii M_jj

/// The state without the sizes behind it.
GaussianState without_sizes(const GaussianState& state, int healthy) {
  GaussianState out;
  out.size = healthy;
  std::copy_n(state.mean.begin(), healthy, out.mean.begin());
  for (int i = 0; i < healthy; ++i)
    for (int j = 0; j < healthy; ++j) out.p(i, j) = state.p(i, j);
  return out;
}

/// Adds what a fault's size is, with its doubt, to the slow state of that kind and joint.
void add_to_slow_state(MotionModel& model, GaussianState& state, SlowKind kind, int joint, double change,
                       double variance) {
  for (std::size_t s = 0; s < model.slow.size(); ++s) {
    SlowState& slow = model.slow[s];
    if (slow.kind != kind || (kind != SlowKind::tip_mass && slow.joint != joint)) continue;
    const int index = 2 * model.joints() + static_cast<int>(s);
    slow.usual += change;
    state.mean[index] += change;
    state.p(index, index) += variance;
  }
}

/// Drives of the joint give this share of the logged torque less.
void lose_torque(FaultyRobot& robot, GaussianState& state, int joint, double share, double variance) {
  for (std::size_t s = 0; s < robot.model.slow.size(); ++s)
    if (robot.model.slow[s].kind == SlowKind::torque_gain && robot.model.slow[s].joint == joint) {
      const double gain = state.mean[2 * robot.model.joints() + static_cast<int>(s)];
      add_to_slow_state(robot.model, state, SlowKind::torque_gain, joint, -share * (1.0 + gain), variance);
      return;
    }
  robot.faults.held[joint] = true;
  robot.explains = false;
}

/// A joint that nothing moves is one of enormous inertia.
void stop_joint(FaultyRobot& robot, GaussianState& state, int joint) {
  const int n = robot.model.joints();
  robot.model.chain.rotor_inertia.resize(n, 0.0);
  robot.model.chain.rotor_inertia[joint] += kImmovable * robot.model.inertia_scale[joint];
  state.mean[n + joint] = 0.0;
}

/// A joint that runs where nobody sees it moves those that feel its inertia: nothing can be told of them.
void lose_sight(FaultyRobot& robot, GaussianState& state, int joint) {
  const int n = robot.model.joints();
  JointVector<double> middle(n);
  for (int j = 0; j < n; ++j) middle[j] = 0.5 * (robot.model.q_low[j] + robot.model.q_high[j]);
  const JointMatrix<double> inertia = inertia_matrix(robot.model.chain, middle);
  for (int j = 0; j < n; ++j) {
    if (inertia(j, joint) * inertia(j, joint) < kCoupled * inertia(j, j) * inertia(joint, joint)) continue;
    robot.closed[j] = true;
    robot.faults.held[j] = j != joint;
  }
  robot.faults.blind[joint] = true;
  stop_joint(robot, state, joint);
  robot.explains = false;
}

}  // namespace

GaussianState take_fault(FaultyRobot& robot, const Hypothesis& hypothesis, const RunningHypothesis& found) {
  const int healthy = robot.model.healthy_states(), j = hypothesis.joint_index();
  const auto size = [&](int s) { return found.state.mean[healthy + s]; };
  const auto variance = [&](int s) { return std::max(found.state.p(healthy + s, healthy + s), 0.0); };
  GaussianState state = without_sizes(found.state, healthy);
  KnownFaults& faults = robot.faults;
  switch (hypothesis.label.kind) {
    case FaultKind::none:
    case FaultKind::collision:
      break;
    case FaultKind::free_swinging:
      lose_torque(robot, state, j, 1.0, 0.0);
      robot.closed[j] = true;
      break;
    case FaultKind::torque_loss:
      lose_torque(robot, state, j, size(0), variance(0));
      break;
    case FaultKind::payload_change:
      add_to_slow_state(robot.model, state, SlowKind::tip_mass, 0, size(0), variance(0));
      break;
    case FaultKind::torque_sensor_error:
      add_to_slow_state(robot.model, state, SlowKind::torque_offset, j, -size(0), variance(0));
      break;
    case FaultKind::friction_increase:
      robot.model.chain.friction[j].viscous += size(0);
      robot.model.chain.friction[j].coulomb += size(1);
      break;
    case FaultKind::sensor_bias:
      faults.bias[j] += size(0);
      break;
    case FaultKind::sensor_drift:
      faults.bias[j] -= size(0) * found.onset_s;
      faults.drift[j] += size(0);
      if (hypothesis.form == HypothesisForm::drifting_velocity) faults.velocity_bias[j] += size(0);
      break;
    case FaultKind::stuck_encoder:
      lose_sight(robot, state, j);
      break;
    case FaultKind::locked:
      stop_joint(robot, state, j);
      robot.closed[j] = true;
      break;
    case FaultKind::unknown:
      faults.held[j] = robot.closed[j] = true;
      robot.explains = false;
      break;
  }
  return state;
}

}  // namespace faultline
