// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/fault/fault_catalogue.hpp"
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

/// What is particular about a hypothesis beside its kind and joint.
enum class HypothesisForm {
  usual,
  rigid_lock,          ///< stopping jolts the other joints
  drifting_velocity,   ///< the velocity is read from the same drifting encoder
  push_on_all_joints,  ///< as a contact at the tip or on an outer link: joint 0, one size a joint
  misread_row,         ///< no fault: one row read wrong, which a wild value must be held against
  work_piece,          ///< no fault: a work piece was picked up or put down
};

/// What may have happened at some moment: a fault of a kind at a joint, its size unknown.
struct Hypothesis {
  FaultLabel label;         ///< joint from 1; 0 for a push on all joints and a misread row
  double duration_s = 0.0;  ///< of a collision's pulse, at most; 0 for faults that stay
  HypothesisForm form = HypothesisForm::usual;
  int sizes = 0;               ///< numbers in the state that say how large it is
  double work_piece_kg = 0.0;  ///< mass that a work piece adds to the tip, or takes from it

  int joint_index() const { return label.joint - 1; }
};

inline bool is_misread(const Hypothesis& hypothesis) {
  return hypothesis.form == HypothesisForm::misread_row;
}
/// No fault at all: the log goes on as that of a healthy robot.
inline bool is_healthy(const Hypothesis& hypothesis) { return hypothesis.label.kind == FaultKind::none; }
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

/// The bank: every kind at every joint, first the kinds that a torque measured behind the drive hides, which
/// are left out where it is measured there, then the others in the order of the catalogue.
/// Work pieces (kg) that the robot carries every day come and go without being a fault.
std::vector<Hypothesis> hypotheses_of(int joints, TorqueMeaning torque,
                                      const std::vector<double>& work_pieces_kg = {});

/// The distinct labels of a bank in its order; `label_of[i]` is the label of hypothesis i.
struct HypothesisLabels {
  std::vector<FaultLabel> labels;
  std::vector<int> label_of;
};
HypothesisLabels labels_of(const std::vector<Hypothesis>& bank);

}  // namespace faultline
