// SPDX-License-Identifier: MIT
#include "lib/diagnosis/describe_episode.hpp"

namespace faultline {

DescribedEpisode describe_episode(const MonitoredEpisode& observed, const Model& model) {
  DescribedEpisode out;
  out.evidence = evidence_by_label(observed.evidence, model.bank, model.motion);
  Episode& episode = out.episode;
  episode.features =
      episode_features(observed.evidence, out.evidence, observed.residuals, model.robot.joints());
  episode.evidence = observed.evidence.hypotheses[observed.evidence.best].log_likelihood_ratio;
  if (!model.episode_classifier.trained()) return out;
  const Opinions opinions = classify_episode(model.episode_classifier, episode.features);
  episode.mlp = opinions.mlp;
  episode.rbfn = opinions.rbfn;
  return out;
}

}  // namespace faultline
