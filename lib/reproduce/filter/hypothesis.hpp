// SPDX-License-Identifier: MIT
#pragma once

#include "lib/fault/fault_catalogue.hpp"

namespace faultline {

/// What is particular about a hypothesis beside its kind and joint.
enum class HypothesisForm {
  usual,
  rigid_lock,          ///< stopping jolts the other joints
  drifting_velocity,   ///< the velocity is read from the same drifting encoder
  push_on_all_joints,  ///< as a contact at the tip or on an outer link: joint 0, one size a joint
};

/// What may have happened at some moment: a fault of a kind at a joint, its size unknown.
struct Hypothesis {
  FaultLabel label;         ///< joint from 1; 0 for a push on all joints
  double duration_s = 0.0;  ///< of a collision's pulse, at most; 0 for faults that stay
  HypothesisForm form = HypothesisForm::usual;
  int sizes = 0;  ///< numbers in the state that say how large it is

  int joint_index() const { return label.joint - 1; }
};

inline bool is_everywhere(const Hypothesis& hypothesis) {
  return hypothesis.form == HypothesisForm::push_on_all_joints;
}

/// What the catalogue says of size `s` of the hypothesis (a push on all joints has one size a joint, all
/// alike), and the joint it belongs to, from 0.
inline const FaultSize& described_size(const Hypothesis& hypothesis, int s) {
  return describe(hypothesis.label.kind).size[is_everywhere(hypothesis) ? 0 : s];
}
inline int joint_of_size(const Hypothesis& hypothesis, int s) {
  return is_everywhere(hypothesis) ? s : hypothesis.joint_index();
}

}  // namespace faultline
