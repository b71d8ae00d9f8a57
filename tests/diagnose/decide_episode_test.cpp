// SPDX-License-Identifier: MIT
#include "lib/diagnose/decide_episode.hpp"

#include <gtest/gtest.h>

#include "tests/diagnose/hand_made_episode.hpp"

namespace faultline {
namespace {

TEST(EpisodeOf, HasOneNumberPerFeatureAndTheBestEvidence) {
  const Model model = hand_made_rrp();
  const Episode episode = seen(episode_of_fault(kLocked2, 77.0), model);
  EXPECT_EQ(episode.features.size(), features_of(model).size());
  EXPECT_EQ(episode.evidence, 77.0);
  EXPECT_EQ(episode.mlp, Opinion{}) << "a model without networks has no opinion";
}

TEST(EpisodeOf, CarriesTheOpinionsOfBothNetworks) {
  const Model model = hand_made_rrp({kLocked2, 0.9}, {kStuck2, 0.6});
  const Episode episode = seen(episode_of_fault(kLocked2), model);
  EXPECT_EQ(episode.mlp.label, kLocked2);
  EXPECT_NEAR(episode.mlp.confidence, 0.9, 1e-12);
  EXPECT_EQ(episode.rbfn.label, kStuck2);
  EXPECT_NEAR(episode.rbfn.confidence, 0.6, 1e-12);
}

TEST(EpisodeOf, ResidualsAreTheLastFeatures) {
  const Model model = hand_made_rrp();
  const auto features = seen(episode_of_fault(kLocked2), model, residuals_of({1.0, kNaN, 20.0})).features;
  const std::size_t n = features.size();
  EXPECT_EQ(features[n - 3], 0.0);
  EXPECT_EQ(features[n - 2], 0.0) << "not a number counts as healthy";
  EXPECT_NEAR(features[n - 1], std::log(20.0), 1e-12);
}

TEST(DecideEpisode, NetworksThatAgreeNameTheFault) {
  const Model model = hand_made_rrp({kLocked2, 0.9}, {kLocked2, 0.7});
  const MonitoredEpisode episode = episode_of_fault(kLocked2);
  const FaultFinding finding = decide_episode(episode, model, base_of(model, episode, kLocked2, 3));
  EXPECT_EQ(finding.label, kLocked2);
  EXPECT_EQ(finding.decided_by, DecidedBy::agreement);
  EXPECT_NEAR(finding.confidence, 0.8, 1e-12);
  EXPECT_EQ(item(finding, "decision")->text, "both networks agree: joint 2 is locked");
  EXPECT_EQ(item(finding, "warning"), nullptr);
  EXPECT_EQ(finding.precedents.size(), 3u);
  EXPECT_TRUE(finding.could_also_be.empty());
}

TEST(DecideEpisode, TimesAndTraceComeFromTheEvidence) {
  const Model model = hand_made_rrp({kLocked2, 0.9}, {kLocked2, 0.7});
  MonitoredEpisode episode = episode_of_fault(kLocked2);
  episode.fault.trace.time = {2.0, 2.1};
  const FaultFinding finding = decide_episode(episode, model, empty_base(model));
  EXPECT_EQ(finding.onset_s, 2.0);
  EXPECT_EQ(finding.alarm_s, 2.1);
  EXPECT_EQ(finding.end_s, 4.0);
  EXPECT_EQ(finding.trace.time, episode.fault.trace.time);
}

TEST(DecideEpisode, SimilarCasesChooseBetweenFaultsThatExplainTheLogEquallyWell) {
  const Model model = hand_made_rrp({kLocked2, 0.6}, {kStuck2, 0.9});
  MonitoredEpisode episode = episode_of_fault(kLocked2);
  explain_alike(episode, kStuck2, 99.0);
  const FaultFinding finding = decide_episode(episode, model, base_of(model, episode, kStuck2, 5));
  EXPECT_EQ(finding.label, kStuck2);
  EXPECT_EQ(finding.decided_by, DecidedBy::cases);
  EXPECT_NEAR(finding.confidence, 5.9 / 6.5, 1e-12) << "five cases and the RBFN against the MLP";
  ASSERT_EQ(finding.precedents.size(), 5u);
  EXPECT_EQ(finding.precedents[0].what_was_done, "changed the brake");
  EXPECT_NE(alternative(finding, kLocked2), nullptr) << "what explains the log best is always listed";
}

TEST(DecideEpisode, AFaultThatTheLogExcludesIsNotNamedDespiteNetworksAndCases) {
  const Model model = hand_made_rrp({kBias3, 0.9}, {kBias3, 0.9});
  MonitoredEpisode episode = episode_of_fault(kLocked2);
  explain(episode, kBias3, 40.0);
  const FaultFinding finding = decide_episode(episode, model, base_of(model, episode, kBias3, 3));
  EXPECT_EQ(finding.label, kLocked2);
  EXPECT_EQ(finding.decided_by, DecidedBy::evidence);
  EXPECT_NE(item(finding, "decision")->text.find("the position sensor of joint 3 reads a shifted position"),
            std::string::npos);
  EXPECT_NE(alternative(finding, kBias3), nullptr);
}

TEST(DecideEpisode, TheEvidenceDecidesIfNetworksAndCasesDoNot) {
  const Model model = hand_made_rrp({kBias3, 0.9}, {kDrift1, 0.5});
  MonitoredEpisode episode = episode_of_fault(kLocked2);
  explain_alike(episode, kStuck2, 99.0);
  const FaultFinding finding = decide_episode(episode, model, empty_base(model));
  EXPECT_EQ(finding.label, kLocked2);
  ASSERT_EQ(finding.decided_by, DecidedBy::evidence);
  EXPECT_NEAR(finding.confidence, 1.0 / (1.0 + std::exp(-1.0)), 1e-9) << "one nat ahead of one other label";
  EXPECT_NE(alternative(finding, kStuck2), nullptr);
  EXPECT_NE(alternative(finding, kBias3), nullptr);
}

TEST(DecideEpisode, AFaultOfNoKnownFormIsUnknownDespiteNetworksThatAgree) {
  const Model model = hand_made_rrp({kLocked2, 0.9}, {kLocked2, 0.9});
  MonitoredEpisode episode = episode_of_fault(kLocked2);
  episode.fault.claim.kind = FaultKind::unknown;
  episode.fault.could_also_be = {kLocked2};
  episode.fault.misfit = 512.0;
  const FaultFinding finding = decide_episode(episode, model, base_of(model, episode, kLocked2, 3));
  EXPECT_EQ(finding.label, kUnknown);
  ASSERT_NE(alternative(finding, kLocked2), nullptr);
  EXPECT_EQ(alternative(finding, kLocked2)->why, "is the nearest of the known faults");
  EXPECT_EQ(item(finding, "misfit")->value, 512.0);
}

TEST(DecideEpisode, ANameByEvidenceKeepsNoWarningOfTheNameItReplaced) {
  const Model model = hand_made_rrp({kBias3, 0.6}, {kDrift1, 0.6});
  const MonitoredEpisode episode = episode_of_fault(kLocked2);
  CaseBase base = base_of(model, episode, kUnknown, 1);
  base.reject(1, kUnknown);
  const FaultFinding finding = decide_episode(episode, model, base);
  ASSERT_EQ(finding.label, kLocked2) << "even votes leave it to the evidence";
  EXPECT_EQ(item(finding, "warning"), nullptr) << "that `unknown` was wrong once says nothing of locked";
}

TEST(DecideEpisode, ARejectionOfTheNameByEvidenceWarns) {
  const Model model = hand_made_rrp({kBias3, 0.6}, {kDrift1, 0.6});
  const MonitoredEpisode episode = episode_of_fault(kLocked2);
  CaseBase base = base_of(model, episode, kLocked2, 1);
  base.reject(1, kUnknown);
  const FaultFinding finding = decide_episode(episode, model, base);
  ASSERT_EQ(finding.decided_by, DecidedBy::evidence);
  ASSERT_NE(item(finding, "warning"), nullptr);
  EXPECT_NE(item(finding, "warning")->text.find("had the same diagnosis, joint 2 is locked, which was wrong"),
            std::string::npos);
}

}  // namespace
}  // namespace faultline
