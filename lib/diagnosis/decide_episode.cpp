// SPDX-License-Identifier: MIT
#include "lib/diagnosis/decide_episode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/cases/decide.hpp"
#include "lib/classify/episode_features.hpp"
#include "lib/diagnosis/decision.hpp"
#include "lib/fault/fault_words.hpp"

namespace faultline {
namespace {

constexpr double kCloseRatio = 10.0;  // labels whose evidence is this near cannot be told apart

std::vector<double> residual_rms(std::span<const JointResidual> residuals, int joints) {
  std::vector<double> rms(joints, std::numeric_limits<double>::quiet_NaN());
  for (int j = 0; j < joints && j < static_cast<int>(residuals.size()); ++j)
    rms[j] = residuals[j].velocity_rms;
  return rms;
}

/// Labels whose evidence comes near that of the finding, and the joints that a push on all joints reaches.
void add_close_labels(FaultFinding& finding, const EpisodeEvidence& episode,
                      const std::vector<LabelEvidence>& evidence, const Model& model) {
  double best = 0.0;
  for (const LabelEvidence& e : evidence) best = std::max(best, e.log_likelihood_ratio);
  for (const LabelEvidence& e : evidence)
    if (e.label.kind != FaultKind::unknown && e.log_likelihood_ratio > best - kCloseRatio)
      add_alternative(finding, e.label, "explains the log almost as well");
  const LabelEvidence likely = likeliest(evidence);
  if (likely.label.joint > 0)
    add_alternative(finding, likely.label, "explains the log best by its likelihood");
  if (finding.label.kind != FaultKind::collision) return;
  const HypothesisEvidence* everywhere = nullptr;
  for (std::size_t h = 0; h < model.bank.size(); ++h)
    if (is_everywhere(model.bank[h]) &&
        (!everywhere || episode.hypotheses[h].log_likelihood_ratio > everywhere->log_likelihood_ratio))
      everywhere = &episode.hypotheses[h];
  if (!everywhere || everywhere->log_likelihood_ratio < best - kCloseRatio) return;
  auto push = [&](int j) { return std::abs(everywhere->impulse[j]) / model.motion.torque_scale[j]; };
  for (int j = 0; j < model.robot.joints(); ++j)
    if (push(j) > 0.2 * push(finding.label.joint - 1))
      add_alternative(finding, {FaultKind::collision, j + 1},
                      "the push reached this joint too, as one at the tip does");
}

std::string size_text(const EpisodeEvidence& episode, const Model& model, const FaultLabel& label) {
  const HypothesisEvidence* best = nullptr;
  for (std::size_t h = 0; h < model.bank.size(); ++h)
    if (model.bank[h].label == label &&
        (!best || episode.hypotheses[h].log_likelihood_ratio > best->log_likelihood_ratio))
      best = &episode.hypotheses[h];
  if (!best) return "";
  const bool turns = model.robot.chain.geometry[label.joint - 1].kind == AxisKind::revolute;
  const char* length = turns ? "rad" : "m";
  const char* torque = turns ? "N m" : "N";
  switch (label.kind) {
    case FaultKind::torque_loss:
      return fmt::format("about {:.0f} % of the torque is lost", 100.0 * best->size[0]);
    case FaultKind::sensor_bias:
      return fmt::format("the position reads {:+.4g} {} too much", best->size[0], length);
    case FaultKind::sensor_drift:
      return fmt::format("the position drifts by {:+.3g} {}/s", best->size[0], length);
    case FaultKind::friction_increase:
      return fmt::format("friction rose by {:.3g} {} plus {:.3g} {} s/{} of speed", best->size[1], torque,
                         best->size[0], torque, length);
    case FaultKind::payload_change:
      return fmt::format("the load at the tip changed by {:+.3g} kg", best->size[0]);
    default:
      return "";
  }
}

/// Where networks and cases leave a fault without a name, the likelihood gives one: if a network names it
/// too, or nothing else comes near.
bool prefer_evidence(CaseDecision& decision, const Episode& query,
                     const std::vector<LabelEvidence>& evidence) {
  if (decision.label.kind != FaultKind::unknown) return false;
  const LabelEvidence likely = likeliest(evidence);
  if (likely.label.kind == FaultKind::unknown) return false;
  double second = -std::numeric_limits<double>::infinity();
  for (const LabelEvidence& e : evidence)
    if (e.label.kind != FaultKind::unknown && named_by_size(e.label, evidence) != likely.label)
      second = std::max(second, e.log_likelihood_ratio);
  const bool seconded = likely.label == query.mlp.label || likely.label == query.rbfn.label;
  if (!seconded && likely.log_likelihood_ratio - second < kCloseRatio) return false;
  decision.label = likely.label;
  decision.why = "neither networks nor cases settle it; this fault explains the log best";
  return true;
}

void add_evidence_lines(FaultFinding& finding, const EpisodeEvidence& episode,
                        std::span<const JointResidual> residuals, const Model& model) {
  const double ratio = episode.hypotheses[episode.best].log_likelihood_ratio;
  finding.evidence.push_back(
      {"log_likelihood_ratio", ratio, "nats",
       fmt::format("log likelihood of the fault over a healthy robot (alarm from {:.0f} on)",
                   model.evidence.threshold)});
  const std::string size = finding.label.joint > 0 ? size_text(episode, model, finding.label) : "";
  if (!size.empty()) finding.evidence.push_back({"size", std::numeric_limits<double>::quiet_NaN(), "", size});
  for (std::size_t j = 0; j < residuals.size(); ++j)
    if (std::isfinite(residuals[j].velocity_rms))
      finding.evidence.push_back({fmt::format("mlp_velocity_residual_{}", j + 1), residuals[j].velocity_rms,
                                  "times healthy", fmt::format("MLP residual of joint {}", j + 1)});
}

}  // namespace

Episode episode_of(const EpisodeEvidence& episode, std::span<const JointResidual> residuals,
                   const Model& model) {
  const std::vector<LabelEvidence> evidence = evidence_by_label(episode, model.bank, model.motion);
  Episode out;
  out.features = episode_features(episode, evidence, residual_rms(residuals, model.robot.joints()));
  out.evidence = episode.hypotheses[episode.best].log_likelihood_ratio;
  if (!model.judges.trained()) return out;
  const JudgeOpinions opinions = judge(model.judges, out.features);
  out.mlp = {opinions.mlp.label, opinions.mlp.confidence};
  out.rbfn = {opinions.rbfn.label, opinions.rbfn.confidence};
  return out;
}

FaultFinding decide_episode(const EpisodeEvidence& episode, std::span<const JointResidual> residuals,
                            const Model& model, const CaseBase& cases) {
  FaultFinding finding;
  finding.onset_s = episode.onset_s;
  finding.alarm_s = episode.alarm_s;
  finding.end_s = episode.end_s;
  finding.trace = episode.trace;
  const Episode query = episode_of(episode, residuals, model);
  const std::vector<LabelEvidence> evidence = evidence_by_label(episode, model.bank, model.motion);
  CaseDecision decision = decide(query, cases);
  decision.label = named_by_size(decision.label, evidence);
  const bool by_evidence = prefer_evidence(decision, query, evidence);
  apply_decision(finding, query, cases, decision);
  if (by_evidence) finding.decided_by = DecidedBy::evidence;
  add_close_labels(finding, episode, evidence, model);
  add_evidence_lines(finding, episode, residuals, model);
  return finding;
}

}  // namespace faultline
