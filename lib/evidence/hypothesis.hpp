// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/fault/fault_kind.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// How large faults are before anything is seen of them: normal priors in SI units, one number a joint. The
/// priors make hypotheses with and without a free size comparable.
struct SizePriors {
  std::vector<double> bias;              ///< rad or m, standard deviation about 0
  std::vector<double> drift;             ///< per second, standard deviation about 0
  std::vector<double> viscous_increase;  ///< N m s/rad or N s/m, mean and standard deviation
  std::vector<double> coulomb_increase;  ///< N m or N, mean and standard deviation
  std::vector<double> external_torque;   ///< N m or N, standard deviation about 0
  double payload = 0.0;                  ///< kg, standard deviation about 0
};

/// What may have happened at some moment: a fault of a kind at a joint, its size unknown.
struct Hypothesis {
  FaultLabel label;         ///< joint from 1
  double duration_s = 0.0;  ///< of a collision's pulse, at most; 0 for faults that stay
  /// Of a drift: the velocity is read from the same drifting encoder. Of a lock: it is rigid, so that
  /// stopping jolts the other joints.
  bool variant = false;
  int sizes = 0;  ///< numbers in the state that say how large it is

  int joint_index() const { return label.joint - 1; }
};

/// That nothing happened but one row read wrong: no fault, but what a wild value must be held against.
inline bool is_misread(const Hypothesis& hypothesis) { return hypothesis.label.kind == FaultKind::none; }

/// A collision that pushes all joints at once, as a contact at the tip or on an outer link does: joint 0, one
/// size a joint.
inline bool is_everywhere(const Hypothesis& hypothesis) {
  return hypothesis.label.kind == FaultKind::collision && hypothesis.label.joint == 0;
}

/// The bank: every kind at every joint. Loss of torque is left out where the logged torque is measured behind
/// the drive, since it is then inside the measurement.
std::vector<Hypothesis> hypotheses_of(int joints, TorqueMeaning torque);

/// The distinct labels of a bank in its order; `label_of[i]` is the label of hypothesis i.
struct HypothesisLabels {
  std::vector<FaultLabel> labels;
  std::vector<int> label_of;
};
HypothesisLabels labels_of(const std::vector<Hypothesis>& bank);

/// Such as "torque_loss 2".
std::string to_string(const FaultLabel& label);

}  // namespace faultline
