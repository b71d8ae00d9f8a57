// SPDX-License-Identifier: MIT
#include "lib/evidence/hypothesis.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace faultline {
namespace {

constexpr std::array<double, 5> kPulses_s = {0.04, 0.1, 0.25, 0.5, 1.0};  // from a knock to a push aside
constexpr std::array<double, 1> kLasting = {0.0};

/// The form beside the usual one that a kind may take at a joint.
HypothesisForm other_form(FaultKind kind) {
  if (kind == FaultKind::locked) return HypothesisForm::rigid_lock;
  if (kind == FaultKind::sensor_drift) return HypothesisForm::drifting_velocity;
  return HypothesisForm::usual;
}

void add_at_joints(std::vector<Hypothesis>& bank, const Hypothesis& like, int joints) {
  const bool at_tip = describe(like.label.kind).place == FaultPlace::tip;
  for (int j = at_tip ? joints : 1; j <= joints; ++j) {
    bank.push_back(like);
    bank.back().label.joint = j;
  }
}

void add_kind(std::vector<Hypothesis>& bank, const FaultDescription& fault, int joints) {
  const HypothesisForm other = other_form(fault.kind);
  for (const double duration_s : fault.passes ? std::span<const double>(kPulses_s) : kLasting) {
    Hypothesis like{{fault.kind, 0}, duration_s, HypothesisForm::usual, fault.size_count};
    add_at_joints(bank, like, joints);
    like.form = other;
    if (other != HypothesisForm::usual) add_at_joints(bank, like, joints);
    if (fault.passes && joints > 1)
      bank.push_back({{fault.kind, 0}, duration_s, HypothesisForm::push_on_all_joints, joints});
  }
}

}  // namespace

std::vector<Hypothesis> hypotheses_of(int joints, TorqueMeaning torque,
                                      const std::vector<double>& work_pieces_kg) {
  std::vector<Hypothesis> bank;
  for (const bool hidden : {true, false}) {
    if (hidden && torque == TorqueMeaning::measured) continue;
    for (int k = 0; k < kFaultKinds; ++k) {
      const FaultDescription& fault = describe(static_cast<FaultKind>(k));
      if (fault.place != FaultPlace::nowhere && fault.hidden_by_measured_torque == hidden)
        add_kind(bank, fault, joints);
    }
  }
  bank.push_back({{FaultKind::none, 0}, 0.0, HypothesisForm::misread_row, 0});
  for (const double mass : work_pieces_kg)
    for (const double change : {mass, -mass})
      bank.push_back({{FaultKind::none, 0}, 0.0, HypothesisForm::work_piece, 0, change});
  return bank;
}

HypothesisLabels labels_of(const std::vector<Hypothesis>& bank) {
  HypothesisLabels out;
  for (const Hypothesis& hypothesis : bank) {
    const auto found = std::find(out.labels.begin(), out.labels.end(), hypothesis.label);
    out.label_of.push_back(static_cast<int>(found - out.labels.begin()));
    if (found == out.labels.end()) out.labels.push_back(hypothesis.label);
  }
  return out;
}

}  // namespace faultline
