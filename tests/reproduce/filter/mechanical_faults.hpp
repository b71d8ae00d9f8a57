// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "lib/core/random.hpp"
#include "lib/fault/label_text.hpp"
#include "lib/reproduce/filter/fault_dynamics.hpp"
#include "tests/reproduce/filter/faulty_scara.hpp"
#include "tests/support/hand_made_model.hpp"

namespace faultline::mechanical {

/// The library's dynamics of a closed-form robot.
struct Twin {
  FaultyScara truth;
  MotionModel model;
  FaultDynamics dynamics;

  explicit Twin(const FaultyScara& robot = {})
      : truth(robot), model(hand_made_model(robot.robot())), dynamics(model) {}
  Twin(const Twin&) = delete;
};

/// A hypothesis, its sizes, and the robot it makes of the closed form.
struct Fault {
  Hypothesis hypothesis;
  FaultyScara::Triple size{};
  FaultyScara truth{};
};

inline Fault fault_of(FaultKind kind, int joint, FaultyScara::Triple size = {}) {
  const HypothesisForm form = joint == 0 ? HypothesisForm::push_on_all_joints : HypothesisForm::usual;
  Fault fault{{{kind, joint}, 0.1, form, 2}, size, {}};
  FaultyScara& truth = fault.truth;
  if (kind == FaultKind::payload_change) truth.m3 += size[0];
  if (kind == FaultKind::locked) truth.locked = joint - 1;
  if (joint == 0) {
    fault.hypothesis.sizes = 3;
    truth.push = size;
    return fault;
  }
  const auto j = static_cast<std::size_t>(joint - 1);
  if (kind == FaultKind::free_swinging) truth.arrives[j] = 0.0;
  if (kind == FaultKind::torque_loss) truth.arrives[j] = 1.0 - size[0];
  if (kind == FaultKind::collision || kind == FaultKind::unknown) truth.push[j] = size[0];
  if (kind == FaultKind::friction_increase) {
    truth.fv[j] += size[0];
    truth.fc[j] += size[1];
  }
  return fault;
}

inline std::vector<Fault> every_fault() {
  std::vector<Fault> all = {fault_of(FaultKind::payload_change, 3, {1.4}),
                            fault_of(FaultKind::payload_change, 3, {-1.1}),
                            fault_of(FaultKind::collision, 0, {12.0, -7.0, 30.0})};
  for (int joint = 1; joint <= 3; ++joint) {
    all.push_back(fault_of(FaultKind::free_swinging, joint));
    all.push_back(fault_of(FaultKind::torque_loss, joint, {0.6}));
    all.push_back(fault_of(FaultKind::locked, joint));
    all.push_back(fault_of(FaultKind::friction_increase, joint, {4.0, 5.0}));
    all.push_back(fault_of(FaultKind::collision, joint, {-25.0}));
    all.push_back(fault_of(FaultKind::unknown, joint, {9.0}));
    for (const FaultKind kind : {FaultKind::sensor_bias, FaultKind::sensor_drift, FaultKind::stuck_encoder})
      all.push_back(fault_of(kind, joint, {0.1}));
  }
  return all;
}

inline SizedFault sized(const Fault& fault) { return {&fault.hypothesis, fault.size}; }

inline JointArray joint_array(const FaultyScara::Triple& values) {
  JointArray out{};
  std::copy(values.begin(), values.end(), out.begin());
  return out;
}

inline MotionState motion_of(const FaultyScara::State& x) { return {joint_array(x.q), joint_array(x.dq)}; }

inline std::string name_of(const Fault& fault) { return label_text(fault.hypothesis.label); }

/// A robot somewhere in motion; a locked joint is at rest.
inline FaultyScara::State draw_state(Random& random, const Fault& fault) {
  FaultyScara::State x;
  for (int j = 0; j < 3; ++j) {
    x.q[j] = j < 2 ? random.uniform(-2.5, 2.5) : random.uniform(-0.3, 0.0);
    x.dq[j] = j < 2 ? random.uniform(-2.0, 2.0) : random.uniform(-0.4, 0.4);
  }
  if (fault.truth.locked >= 0) x.dq[fault.truth.locked] = 0.0;
  return x;
}

inline FaultyScara::Triple draw_torque(Random& random) {
  return {random.uniform(-20.0, 20.0), random.uniform(-10.0, 10.0), random.uniform(5.0, 45.0)};
}

}  // namespace faultline::mechanical
