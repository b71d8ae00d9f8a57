// SPDX-License-Identifier: MIT
#include "lib/cases/possible_labels.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {
namespace {

constexpr const char* kOfLabel = "behind ";  // prefix of the feature of each hypothesis

[[noreturn]] void refuse_label(const std::string& where, const std::string& message) {
  throw Error(ErrorCode::usage, where, message);
}

/// Whether the base's model has the label as a hypothesis. A model without mechanics has no hypotheses and
/// excludes none.
bool is_compared(const CaseBase& base, const FaultLabel& label) {
  const auto& features = base.metric().features;
  return std::none_of(features.begin(), features.end(),
                      [](const Feature& f) { return f.name.starts_with(kOfLabel); }) ||
         std::any_of(features.begin(), features.end(),
                     [&](const Feature& f) { return f.name == kOfLabel + label_text(label); });
}

}  // namespace

int joints_of(const CaseBase& base) { return static_cast<int>(base.robot().axes.size()); }

void check_joint(int joints, const FaultLabel& label, const std::string& where) {
  if (label.joint.index() >= joints)
    refuse_label(where, fmt::format("is a fault of joint {}, but the robot has {}", label.joint,
                                    counted(joints, "joint")));
}

void check_place(int joints, const FaultLabel& label, const std::string& where) {
  check_joint(joints, label, where);
  if (label.kind == FaultKind::unknown) return;  // at any joint, or without one
  const std::string kind = to_string(label.kind);
  const FaultPlace place = describe(label.kind).place;
  if (place == FaultPlace::nowhere && label.joint != Joint())
    refuse_label(where, "\"" + kind + "\" has no joint; leave the joint out");
  if (place == FaultPlace::joint && label.joint == Joint())
    refuse_label(where, "\"" + kind + "\" is a fault of a joint; give its number, counted from 1");
}

void check_label(const CaseBase& base, const FaultLabel& label, const std::string& where) {
  check_place(joints_of(base), label, where);
  const bool is_fault = label.kind != FaultKind::none && label.kind != FaultKind::unknown;
  const bool has_case = std::any_of(base.cases().begin(), base.cases().end(),
                                    [&](const Case& c) { return c.label.kind == label.kind; });
  if (is_fault && !is_compared(base, label) && !has_case)
    refuse_label(where, "\"" + label_text(label) +
                            "\" is not among the faults that the model of this case base can find, given the "
                            "meaning of the torque in this robot's logs, and no labelled log showed one");
}

FaultLabel with_tip(FaultLabel label, int joints) {
  if (describe(label.kind).place == FaultPlace::link && label.joint == Joint())
    label.joint = Joint::at(joints - 1);
  return label;
}

}  // namespace faultline
