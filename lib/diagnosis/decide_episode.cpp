// SPDX-License-Identifier: MIT
#include "lib/diagnosis/decide_episode.hpp"

#include "lib/diagnosis/decision.hpp"
#include "lib/diagnosis/finding.hpp"

namespace faultline {

Episode episode_of(const MonitoredEpisode& observed, const std::vector<LabelEvidence>& evidence,
                   const Model& model) {
  Episode episode;
  episode.features = episode_features(observed.evidence, evidence, observed.residuals, model.robot.joints());
  episode.evidence = observed.evidence.hypotheses[observed.evidence.best].log_likelihood_ratio;
  if (!model.episode_classifier.trained()) return episode;
  const Opinions opinions = classify_episode(model.episode_classifier, episode.features);
  episode.mlp = opinions.mlp;
  episode.rbfn = opinions.rbfn;
  return episode;
}

FaultFinding decide_episode(const MonitoredEpisode& observed, const Model& model, const CaseBase& cases) {
  DecisionBasis basis;
  basis.evidence = evidence_by_label(observed.evidence, model.bank, model.motion);
  basis.episode = episode_of(observed, basis.evidence, model);
  basis.votes = votes_on(basis.episode, cases);
  const Decision decision = decide(basis);
  return finding_of(decision, basis, observed, model);
}

}  // namespace faultline
