// SPDX-License-Identifier: MIT
#include "apps/work/learning.hpp"

#include <utility>

#include "apps/work/carried_cases.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/cases/possible_labels.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

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

}  // namespace

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
