// SPDX-License-Identifier: MIT
#include "apps/work/learning.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

#include "lib/cases/case_file.hpp"
#include "lib/cases/possible_labels.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr const char* kAdvice = "; write to another -o, or move the case base away";

/// Returns the label of a log; nullopt for none. Throws Error(usage) for a label impossible for this robot.
std::optional<LogLabel> checked_label(const std::vector<LogLabel>& labels, const Robot& robot,
                                      const std::string& log) {
  const LogLabel* const found = label_of(labels, log);
  if (!found) return {};
  LogLabel label = *found;
  label.label = with_tip(label.label, robot.joints());
  check_place(robot.joints(), label.label, log + ", by its label");
  return label;
}

/// Throws Error(input) when the existing case base cannot be read, or has cases added by people for joints
/// that this robot lacks: learning would lose them. Throws Error(output) when it is read-only.
void check_can_carry_over(const std::string& case_base, int joints) {
  if (::access(case_base.c_str(), W_OK) != 0)
    throw Error(ErrorCode::output, case_base,
                std::string("already exists and cannot be changed: it is read-only") + kAdvice);
  CaseBase there;
  try {
    there = read_case_base(case_base);
  } catch (const Error& error) {
    throw Error(
        ErrorCode::input, case_base,
        "already exists, but its confirmed cases cannot be carried over: it " + error.message() + kAdvice);
  }
  for (const Case& c : there.cases())
    if (!is_made_by_learn(c) && c.label.joint.index() >= joints)
      throw Error(ErrorCode::input, case_base,
                  fmt::format("already exists and holds case {} of joint {}, but this robot has {}{}", c.id,
                              c.label.joint, counted(joints, "joint"), kAdvice));
}

}  // namespace

std::string carried_text(const std::optional<CarriedCases>& carried) {
  if (!carried) return "";
  std::string text =
      fmt::format("A case base already existed: {} made by learn {} made again, {} carried over",
                  counted(carried->replaced, "case"), carried->replaced == 1 ? "was" : "were",
                  counted(carried->carried, "other"));
  if (carried->recomputed > 0) text += fmt::format(", {} with new features", carried->recomputed);
  if (carried->old_features > 0)
    text += fmt::format(", {} marked and kept with the features of the earlier model", carried->old_features);
  if (carried->renumbered > 0) text += fmt::format(", {} under another number", carried->renumbered);
  return text + ".\n";
}

bool OpenLogs::add(const std::string& name, std::unique_ptr<LogSource> log,
                   const std::vector<LogLabel>& labels, const Robot& robot) {
  owners.push_back(std::move(log));
  const std::optional<LogLabel> label = checked_label(labels, robot, name);
  if (label && label->label.kind != FaultKind::none)
    labelled.push_back({owners.back().get(), label->label, label->onset_s});
  else
    healthy.push_back(owners.back().get());
  return label || labels.empty();
}

void OpenLogs::require_healthy() const {
  if (healthy.empty())
    throw Error(ErrorCode::usage, "faultline learn",
                "all logs are labelled with faults; at least one log of a healthy run is needed");
}

void check_writable(const ModelPaths& paths, const Robot& robot) {
  const std::string path = paths.case_base();
  if (has_case_base(path))
    check_can_carry_over(path, robot.joints());
  else
    const AtomicFile cases(path);
  const AtomicFile model(paths.model);
}

std::optional<CarriedCases> write_model(const Model& model, CaseBase& cases, const ModelPaths& paths) {
  const std::string text = model_to_json(model);
  model_from_json(text, paths.model);  // ensures that the text can be read
  AtomicFile file(paths.model);
  file.write(text);
  std::optional<CarriedCases> carried;
  replace_case_base(paths.case_base(), [&](const CaseBase* there) {
    if (there) carried = carry_over(*there, cases);
    return cases;
  });
  file.commit();
  return carried;
}

}  // namespace faultline
