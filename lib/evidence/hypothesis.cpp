// SPDX-License-Identifier: MIT
#include "lib/evidence/hypothesis.hpp"

#include <algorithm>
#include <array>

namespace faultline {
namespace {

constexpr std::array<double, 3> kCollisionDurations = {0.04, 0.1, 0.25};  // s

}  // namespace

std::vector<Hypothesis> hypotheses_of(int joints, TorqueMeaning torque) {
  std::vector<Hypothesis> bank;
  auto each_joint = [&](FaultKind kind, int sizes, double duration_s = 0.0, bool variant = false) {
    for (int j = 1; j <= joints; ++j) bank.push_back({{kind, j}, duration_s, variant, sizes});
  };
  if (torque != TorqueMeaning::measured) {
    each_joint(FaultKind::free_swinging, 0);
    each_joint(FaultKind::torque_loss, 1);
  }
  each_joint(FaultKind::locked, 0);
  each_joint(FaultKind::locked, 0, 0.0, true);
  each_joint(FaultKind::sensor_bias, 1);
  each_joint(FaultKind::stuck_encoder, 0);
  each_joint(FaultKind::sensor_drift, 1);
  each_joint(FaultKind::sensor_drift, 1, 0.0, true);
  each_joint(FaultKind::friction_increase, 2);
  bank.push_back({{FaultKind::payload_change, joints}, 0.0, false, 1});
  for (const double duration_s : kCollisionDurations) {
    each_joint(FaultKind::collision, 1, duration_s);
    if (joints > 1) bank.push_back({{FaultKind::collision, 0}, duration_s, false, joints});
  }
  each_joint(FaultKind::unknown, 1);
  bank.push_back({{FaultKind::none, 0}, 0.0, false, 0});
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

std::string to_string(const FaultLabel& label) {
  const std::string kind = to_string(label.kind);
  return label.joint > 0 ? kind + " " + std::to_string(label.joint) : kind;
}

}  // namespace faultline
