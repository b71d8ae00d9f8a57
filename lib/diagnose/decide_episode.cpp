// SPDX-License-Identifier: MIT
#include "lib/diagnose/decide_episode.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "lib/cases/case.hpp"
#include "lib/cases/compare_cases.hpp"
#include "lib/classify/episode_features.hpp"
#include "lib/diagnose/finding.hpp"

namespace faultline {
namespace {

/// Calibrated confidence; that of an unknown fault is kept, since the calibration runs had no such fault.
double calibrated(const Decision& decision, const ConfidenceCalibration& calibration) {
  if (decision.label.kind == FaultKind::unknown) return decision.confidence;
  return calibration.of(confidence_source(decision.decided_by), decision.confidence);
}

/// The data for comparing an episode with cases.
struct Comparing {
  const DecisionBasis& basis;
  const CaseBase& cases;
  const Model& model;
  std::vector<UsualFeature> usual;
  std::vector<EpisodeFeature> list;  ///< empty if the base compares other features than the model has
};

std::vector<PrecedentFeature> as_precedents(const std::vector<FeatureMatch>& matches, const Case& c,
                                            const Comparing& by) {
  std::vector<PrecedentFeature> out;
  if (by.list.empty()) return out;
  for (const FeatureMatch& match : matches) {
    if (out.size() == 3) break;  // longer lists are not read
    const DescribedFeature here = describe_feature(by.list, match.feature, by.basis.episode.features,
                                                   by.model.motion, by.model.robot.chain);
    const DescribedFeature there =
        describe_feature(by.list, match.feature, c.episode.features, by.model.motion, by.model.robot.chain);
    if (!std::isfinite(here.value) || !std::isfinite(there.value)) continue;
    out.push_back(
        {name_of(by.list[match.feature]), here.what, here.unit, here.value, there.value, match.difference});
  }
  return out;
}

Precedent precedent_of(const Neighbour& neighbour, bool voted, const Comparing& by) {
  const Case& c = *neighbour.found;
  const std::string& robot = by.cases.robot().name;
  const Likeness found =
      compare_cases(by.cases.metric(), by.usual, by.basis.episode.features, c.episode.features);
  return {.case_id = c.id,
          .label = c.label,
          .similarity = neighbour.similarity,
          .what_was_done = c.what_was_done,
          .origin = origin_of(c),
          .origin_text = origin_words(c, robot),
          .log = log_name_of(c),
          .robot = c.robot.empty() ? robot : c.robot,
          .person = c.person,
          .date = c.date,
          .voted = voted,
          .alike = as_precedents(found.alike, c, by),
          .unlike = as_precedents(found.unlike, c, by)};
}

/// Returns at most three near cases that were not simulated and did not vote, sorted by origin.
std::vector<Neighbour> more_cases(const DecisionBasis& basis, const CaseBase& cases) {
  std::vector<Neighbour> more = retrieve(cases, basis.episode.features, std::numeric_limits<int>::max(),
                                         cases.metric().near_similarity);
  std::erase_if(more, [&](const Neighbour& n) {
    const auto& voters = basis.votes.precedents;
    return origin_of(*n.found) == CaseOrigin::simulated ||
           std::any_of(voters.begin(), voters.end(),
                       [&](const Neighbour& voter) { return voter.found == n.found; });
  });
  std::stable_sort(more.begin(), more.end(), [](const Neighbour& a, const Neighbour& b) {
    return origin_of(*a.found) < origin_of(*b.found);
  });
  more.resize(std::min<std::size_t>(more.size(), 3));
  return more;
}

}  // namespace

ConfidenceSource confidence_source(DecidedBy decided_by) {
  if (decided_by == DecidedBy::agreement) return ConfidenceSource::networks;
  return decided_by == DecidedBy::cases ? ConfidenceSource::votes : ConfidenceSource::likelihood;
}

FaultFinding decide_episode(const MonitoredEpisode& observed, const Model& model, const CaseBase& cases) {
  DecisionBasis basis = describe_episode(observed, model);
  basis.votes = votes_on(basis.episode, cases);
  Decision decision = decide(basis);
  decision.confidence = calibrated(decision, model.confidence);
  FaultFinding finding = finding_of({observed, basis, decision}, model);
  finding.precedents = precedents_of(basis, cases, model);
  return finding;
}

DecisionBasis describe_episode(const MonitoredEpisode& observed, const Model& model) {
  DecisionBasis out;
  out.likeliest = observed.fault.label();
  out.as_likely = observed.fault.could_also_be;
  out.limit = observed.fault.limit;
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

std::vector<Precedent> precedents_of(const DecisionBasis& basis, const CaseBase& cases, const Model& model) {
  std::vector<EpisodeFeature> list = episode_feature_list(model.labels, model.robot.joints());
  if (list.size() != cases.metric().features.size()) list.clear();
  const Comparing by{basis, cases, model, usual_features(cases), std::move(list)};
  std::vector<Precedent> precedents;
  for (const Neighbour& n : basis.votes.precedents) precedents.push_back(precedent_of(n, true, by));
  for (const Neighbour& n : more_cases(basis, cases)) precedents.push_back(precedent_of(n, false, by));
  std::stable_sort(precedents.begin(), precedents.end(), [](const Precedent& a, const Precedent& b) {
    return std::tuple(a.origin, -a.similarity, a.case_id) < std::tuple(b.origin, -b.similarity, b.case_id);
  });
  return precedents;
}

}  // namespace faultline
