// SPDX-License-Identifier: MIT
#include "lib/diagnose/describe_episode.hpp"

namespace faultline {

DescribedEpisode describe_episode(const MonitoredEpisode& observed, const Model& model) {
  DescribedEpisode out;
  out.evidence = evidence_by_label(observed.fault, observed.end_s, model.labels, model.motion);
  Episode& episode = out.episode;
  episode.features = episode_features(out.evidence, observed.end_s - observed.onset_s(), observed.residuals,
                                      model.robot.joints());
  episode.evidence = observed.fault.evidence;
  if (!model.episode_classifier.trained()) return out;
  const Opinions opinions = classify_episode(model.episode_classifier, episode.features);
  episode.mlp = opinions.mlp;
  episode.rbfn = opinions.rbfn;
  return out;
}

}  // namespace faultline
