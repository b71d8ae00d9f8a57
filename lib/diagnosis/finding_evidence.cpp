// SPDX-License-Identifier: MIT
#include "lib/diagnosis/finding_evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/diagnosis/decision_words.hpp"
#include "lib/fault/fault_words.hpp"
#include "lib/fault/label_text.hpp"

namespace faultline {
namespace {

/// How large the fault is by the likeliest hypothesis of its label; empty when no hypothesis bears the label.
std::string size_words(const EpisodeEvidence& observed, const Model& model, const FaultLabel& label) {
  const HypothesisEvidence* best = nullptr;
  for (std::size_t h = 0; h < model.bank.size(); ++h)
    if (model.bank[h].label == label &&
        (!best || observed.hypotheses[h].log_likelihood_ratio > best->log_likelihood_ratio))
      best = &observed.hypotheses[h];
  if (!best) return "";
  const bool turns = model.robot.chain.geometry[label.joint - 1].kind == AxisKind::revolute;
  return size_text(label, best->size, turns);
}

/// The ratio of an episode is that of its likeliest hypothesis, which need not be the fault that was named.
std::string whose_likelihood(const EpisodeEvidence& evidence, const Model& model, const FaultLabel& named) {
  if (evidence.best < 0 || model.bank[evidence.best].label == named) return "the fault";
  return "the likeliest fault (" + label_text(model.bank[evidence.best].label, " at joint ") + ")";
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
       fmt::format("log likelihood of {} over a healthy robot (alarm from {:.0f} on)",
                   whose_likelihood(observed.evidence, model, decision.label), model.evidence.threshold)});
  if (decision.label.joint > 0)
    if (std::string size = size_words(observed.evidence, model, decision.label); !size.empty())
      items.push_back(remark("size", std::move(size)));
  const auto label = std::find_if(basis.evidence.begin(), basis.evidence.end(), [&](const LabelEvidence& e) {
    return e.label == (decision.label.kind == FaultKind::unknown ? decision.voted : decision.label);
  });
  if (label != basis.evidence.end() && std::isfinite(label->surprise.mean_square()))
    items.push_back(
        {"left_over", label->surprise.mean_square(), "times noise",
         fmt::format("what {} leaves of the motion (correlation {:.2f} from row to row; 1 and 0 are noise)",
                     label_text(label->label, " at joint "), label->surprise.correlation())});
  for (const JointResidual& residual : observed.residuals)
    if (std::isfinite(residual.velocity_rms))
      items.push_back({fmt::format("mlp_velocity_residual_{}", residual.joint), residual.velocity_rms,
                       "times healthy", fmt::format("MLP residual of joint {}", residual.joint)});
  return items;
}

}  // namespace faultline
