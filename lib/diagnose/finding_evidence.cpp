// SPDX-License-Identifier: MIT
#include "lib/diagnose/finding_evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/diagnose/decision_words.hpp"
#include "lib/fault/fault_words.hpp"
#include "lib/fault/label_text.hpp"

namespace faultline {
namespace {

/// How large the fault is that was named; empty where the log was not explained by it.
std::string size_words(const DecidedEpisode& decided, const Model& model) {
  const FaultLabel& label = decided.decision.label;
  for (const LabelScore& score : decided.observed.fault.scores) {
    if (score.label() != label || score.claim.size.size() == 0) continue;
    const bool turns = model.robot.chain.geometry[label.joint - 1].kind == AxisKind::revolute;
    return size_text(label, sizes_of(score.claim, decided.observed.end_s, model.robot.joints()), turns);
  }
  return "";
}

EvidenceItem remark(const char* name, std::string text) {
  return {.name = name, .unit = {}, .text = std::move(text)};
}

}  // namespace

std::vector<EvidenceItem> finding_evidence(const DecidedEpisode& decided, const Model& model) {
  const auto& [observed, basis, decision] = decided;
  std::vector<EvidenceItem> items;
  items.push_back(remark("decision", reason_in_words(decision, basis)));
  for (std::string& warning : warnings_of_cases(decision, basis.votes))
    items.push_back(remark("warning", std::move(warning)));
  items.push_back(
      {"log_likelihood_ratio", basis.episode.evidence, "nats",
       fmt::format("log likelihood of the fault over a healthy robot (alarm from {:.0f} on)", basis.limit)});
  if (decision.label.joint > 0)
    if (std::string size = size_words(decided, model); !size.empty())
      items.push_back(remark("size", std::move(size)));
  const auto label = std::find_if(basis.evidence.begin(), basis.evidence.end(),
                                  [&](const LabelEvidence& e) { return e.label == decision.label; });
  if (label != basis.evidence.end() && std::isfinite(label->left))
    items.push_back(
        {"left_over", label->left, "times noise",
         fmt::format("what {} leaves of the motion (1 is noise)", label_text(label->label, " at joint "))});
  if (decision.label.kind == FaultKind::unknown)
    items.push_back({"misfit", observed.fault.misfit, "nats",
                     "by which a change of any form explains the log better than the nearest known fault"});
  for (const JointResidual& residual : observed.residuals)
    if (std::isfinite(residual.velocity_rms))
      items.push_back({fmt::format("mlp_velocity_residual_{}", residual.joint), residual.velocity_rms,
                       "times healthy", fmt::format("MLP residual of joint {}", residual.joint)});
  return items;
}

}  // namespace faultline
