// SPDX-License-Identifier: MIT
#include "lib/cases/possible_labels.hpp"

#include <algorithm>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/fault/label_text.hpp"

namespace faultline {
namespace {

constexpr const char* kOfLabel = "behind ";        // prefix of the feature of each hypothesis
constexpr const char* kOfJoint = "mlp residual ";  // prefix of the feature of each joint

[[noreturn]] void refuse_label(const std::string& where, const std::string& message) {
  throw Error(ErrorCode::usage, where, message);
}

bool begins(const Feature& feature, const char* prefix) { return feature.name.starts_with(prefix); }

bool is_compared(const CaseBase& base, const FaultLabel& label) {
  const auto& features = base.metric().features;
  return std::none_of(features.begin(), features.end(),
                      [](const Feature& f) { return begins(f, kOfLabel); }) ||
         std::any_of(features.begin(), features.end(),
                     [&](const Feature& f) { return f.name == kOfLabel + label_text(label); });
}

bool has_case_of(const CaseBase& base, FaultKind kind) {
  return std::any_of(base.cases().begin(), base.cases().end(),
                     [kind](const Case& c) { return c.label.kind == kind; });
}

}  // namespace

int joints_of(const CaseBase& base) {
  if (!base.robot().axes.empty()) return static_cast<int>(base.robot().axes.size());
  const auto& features = base.metric().features;
  return static_cast<int>(
      std::count_if(features.begin(), features.end(), [](const Feature& f) { return begins(f, kOfJoint); }));
}

void check_joint(int joints, const FaultLabel& label, const std::string& where) {
  if (joints > 0 && label.joint > joints)
    refuse_label(where, "is a fault of joint " + std::to_string(label.joint) + ", but the robot has " +
                            counted(joints, "joint"));
}

void check_place(int joints, const FaultLabel& label, const std::string& where) {
  check_joint(joints, label, where);
  if (label.kind == FaultKind::unknown) return;  // at any joint, or without one
  const std::string kind = to_string(label.kind);
  const FaultPlace place = describe(label.kind).place;
  if (place == FaultPlace::nowhere && label.joint != 0)
    refuse_label(where, "\"" + kind + "\" has no joint; leave the joint out");
  if (place == FaultPlace::joint && label.joint == 0)
    refuse_label(where, "\"" + kind + "\" is a fault of a joint; give its number, counted from 1");
}

void check_label(const CaseBase& base, const FaultLabel& label, const std::string& where) {
  check_place(joints_of(base), label, where);
  const bool is_fault = label.kind != FaultKind::none && label.kind != FaultKind::unknown;
  if (is_fault && !is_compared(base, label) && !has_case_of(base, label.kind))
    refuse_label(where, "\"" + label_text(label) +
                            "\" is not among the faults that the model of this case base can find, given the "
                            "meaning of the torque in this robot's logs, and no labelled log showed one");
}

FaultLabel with_tip(FaultLabel label, int joints) {
  if (describe(label.kind).place == FaultPlace::link && label.joint == 0) label.joint = joints;
  return label;
}

}  // namespace faultline
