// SPDX-License-Identifier: MIT
#include "lib/diagnosis/decide_episode.hpp"

#include <gtest/gtest.h>

#include "lib/diagnosis/least_size.hpp"
#include "tests/diagnosis/hand_made_episode.hpp"

namespace faultline {
namespace {

TEST(EpisodeOf, HasOneNumberAFeatureAndTheBestRatio) {
  const Model model = hand_made_rrp();
  const Episode episode = seen(episode_of_fault(model, kLocked2, 77.0), model);
  EXPECT_EQ(episode.features.size(), features_of(model).size());
  EXPECT_EQ(episode.evidence, 77.0);
  EXPECT_EQ(episode.mlp, Opinion{}) << "a model without networks has no opinion";
}

TEST(EpisodeOf, CarriesTheOpinionsOfBothJudges) {
  const Model model = hand_made_rrp({kLocked2, 0.9}, {kStuck2, 0.6});
  const Episode episode = seen(episode_of_fault(model, kLocked2), model);
  EXPECT_EQ(episode.mlp.label, kLocked2);
  EXPECT_NEAR(episode.mlp.confidence, 0.9, 1e-12);
  EXPECT_EQ(episode.rbfn.label, kStuck2);
  EXPECT_NEAR(episode.rbfn.confidence, 0.6, 1e-12);
}

TEST(EpisodeOf, ResidualsAreTheLastFeatures) {
  const Model model = hand_made_rrp();
  const auto features =
      seen(episode_of_fault(model, kLocked2), model, residuals_of({1.0, kNaN, 20.0})).features;
  const std::size_t n = features.size();
  EXPECT_EQ(features[n - 3], 0.0);
  EXPECT_EQ(features[n - 2], 0.0) << "not a number counts as healthy";
  EXPECT_NEAR(features[n - 1], std::log(20.0), 1e-12);
}

TEST(DecideEpisode, NetworksThatAgreeNameTheFault) {
  const Model model = hand_made_rrp({kLocked2, 0.9}, {kLocked2, 0.7});
  const EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  const FaultFinding finding = decide_episode({episode, {}}, model, base_of(model, episode, kLocked2, 3));
  EXPECT_EQ(finding.label, kLocked2);
  EXPECT_EQ(finding.decided_by, DecidedBy::agreement);
  EXPECT_NEAR(finding.confidence, 0.8, 1e-12);
  EXPECT_EQ(item(finding, "decision")->text, "both networks say locked at joint 2");
  EXPECT_EQ(item(finding, "warning"), nullptr);
  EXPECT_EQ(finding.precedents.size(), 3u);
  EXPECT_TRUE(finding.could_also_be.empty());
}

TEST(DecideEpisode, TimesAndTraceComeFromTheEvidence) {
  const Model model = hand_made_rrp({kLocked2, 0.9}, {kLocked2, 0.7});
  EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  episode.trace.time = {2.0, 2.1};
  const FaultFinding finding = decide_episode({episode, {}}, model, empty_base(model));
  EXPECT_EQ(finding.onset_s, 2.0);
  EXPECT_EQ(finding.alarm_s, 2.1);
  EXPECT_EQ(finding.end_s, 4.0);
  EXPECT_EQ(finding.trace.time, episode.trace.time);
}

TEST(DecideEpisode, DisagreementIsSettledBySimilarCases) {
  const Model model = hand_made_rrp({kLocked2, 0.6}, {kStuck2, 0.9});
  EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  explain(episode, model, kStuck2, 99.0);
  const FaultFinding finding = decide_episode({episode, {}}, model, base_of(model, episode, kLocked2, 5));
  EXPECT_EQ(finding.label, kLocked2);
  EXPECT_EQ(finding.decided_by, DecidedBy::cases);
  EXPECT_NEAR(finding.confidence, 5.6 / 6.5, 1e-12) << "five cases and the MLP against the RBFN";
  ASSERT_EQ(finding.precedents.size(), 5u);
  EXPECT_EQ(finding.precedents[0].what_was_done, "changed the brake");
  EXPECT_NE(alternative(finding, kStuck2), nullptr);
}

TEST(DecideEpisode, CasesCanSettleOnWhatTheLikelihoodDoesNotPrefer) {
  const Model model = hand_made_rrp({kLocked2, 0.6}, {kStuck2, 0.6});
  EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  explain(episode, model, kStuck2, 50.0);
  const FaultFinding finding = decide_episode({episode, {}}, model, base_of(model, episode, kStuck2, 5));
  EXPECT_EQ(finding.label, kStuck2);
  EXPECT_EQ(finding.decided_by, DecidedBy::cases);
  EXPECT_NE(alternative(finding, kLocked2), nullptr) << "what explains the log best is always listed";
}

TEST(DecideEpisode, TheLikelihoodNamesWhatANetworkSeconds) {
  const Model model = hand_made_rrp({kBias3, 0.9}, {kLocked2, 0.5});
  EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  explain(episode, model, kStuck2, 95.0);
  const FaultFinding finding = decide_episode({episode, {}}, model, empty_base(model));
  EXPECT_EQ(finding.label, kLocked2);
  EXPECT_EQ(finding.decided_by, DecidedBy::evidence);
  EXPECT_NE(alternative(finding, kStuck2), nullptr);
  EXPECT_NE(alternative(finding, kBias3), nullptr);
}

TEST(DecideEpisode, TheLikelihoodNamesWhatNothingElseComesNear) {
  const Model model = hand_made_rrp({kBias3, 0.9}, {kDrift1, 0.5});
  EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  explain(episode, model, kStuck2, 89.0);
  const FaultFinding finding = decide_episode({episode, {}}, model, empty_base(model));
  EXPECT_EQ(finding.label, kLocked2);
  EXPECT_EQ(finding.decided_by, DecidedBy::evidence);
}

TEST(DecideEpisode, TwoLabelsWithinTenNatsStayUnknownWithoutASecond) {
  const Model model = hand_made_rrp({kBias3, 0.9}, {kDrift1, 0.5});
  EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  explain(episode, model, kStuck2, 91.0);
  const FaultFinding finding = decide_episode({episode, {}}, model, empty_base(model));
  EXPECT_EQ(finding.label, kUnknown);
  EXPECT_EQ(finding.decided_by, DecidedBy::cases);
  EXPECT_NE(alternative(finding, kLocked2), nullptr);
  EXPECT_NE(alternative(finding, kStuck2), nullptr);
}

TEST(DecideEpisode, AnUnknownDisturbanceThatExplainsTwiceAsMuchStaysUnknown) {
  const Model model = hand_made_rrp({kLocked2, 0.9}, {kBias3, 0.5});
  EpisodeEvidence episode = episode_of_fault(model, kLocked2, 49.0);
  explain(episode, model, {FaultKind::unknown, 2}, 100.0);
  const FaultFinding finding = decide_episode({episode, {}}, model, empty_base(model));
  EXPECT_EQ(finding.label, kUnknown);
  explain(episode, model, kLocked2, 51.0);
  EXPECT_EQ(decide_episode({episode, {}}, model, empty_base(model)).label, kLocked2);
}

TEST(DecideEpisode, NetworksThatAgreeOnWhatWouldHaveRaisedNoAlarmAreOverruled) {
  const Model model = hand_made_rrp({kBias3, 0.9}, {kBias3, 0.9});
  EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  explain(episode, model, kBias3, 0.9 * model.evidence.threshold);
  const FaultFinding finding = decide_episode({episode, {}}, model, base_of(model, episode, kBias3, 3));
  EXPECT_EQ(finding.label, kLocked2);
  EXPECT_EQ(finding.decided_by, DecidedBy::evidence);
}

TEST(DecideEpisode, TheLikelihoodDoesNotOverruleNetworksThatAgree) {
  const Model model = hand_made_rrp({kBias3, 0.9}, {kBias3, 0.9});
  EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  explain(episode, model, kBias3, 2.0 * model.evidence.threshold);
  const FaultFinding finding = decide_episode({episode, {}}, model, base_of(model, episode, kBias3, 3));
  EXPECT_EQ(finding.label, kBias3);
  EXPECT_EQ(finding.decided_by, DecidedBy::agreement);
  EXPECT_NE(alternative(finding, kLocked2), nullptr);
}

/// Networks and cases name what raised no alarm, and two other faults explain the log alike; the likelier one
/// is a payload of this size, in the unit of the hypothesis.
FaultFinding undecided_payload(double size) {
  const Model model = hand_made_rrp({kLocked2, 0.9}, {kLocked2, 0.9});
  const double alarm = model.evidence.threshold;
  EpisodeEvidence episode = episode_of_fault(model, {FaultKind::payload_change, 3}, 3.0 * alarm, size);
  explain(episode, model, kLoss1, 3.0 * alarm - 2.0, 0.5);
  return decide_episode({episode, {}}, model, empty_base(model));
}

TEST(DecideEpisode, WhatIsTooSmallToBeToldApartIsNamedByTheLikelihoodAndListedAsSmall) {
  constexpr double kTiny = 1e-6;
  const double least = kTiny / undecided_payload(kTiny).extent.times_least;
  const FaultFinding small = undecided_payload(0.8 * least);
  EXPECT_EQ(small.label, (FaultLabel{FaultKind::payload_change, 3}));
  EXPECT_NEAR(small.extent.times_least, 0.8, 1e-9);
  std::vector<FaultFinding> faults = {small};
  EXPECT_EQ(take_small_changes(faults).size(), 1u);
  EXPECT_EQ(undecided_payload(1.2 * least).label, kUnknown) << "it matters, so it is not named by guess";
}

TEST(DecideEpisode, ThinEvidenceIsNotNamed) {
  const Model model = hand_made_rrp({kLocked2, 0.9}, {kLocked2, 0.9});
  EpisodeEvidence episode = episode_of_fault(model, kBias3, 4.0);
  explain(episode, model, kDrift1, 3.9);
  const FaultFinding finding = decide_episode({episode, {}}, model, empty_base(model));
  EXPECT_EQ(finding.label, kUnknown);
  EXPECT_EQ(finding.decided_by, DecidedBy::abstained);
  EXPECT_EQ(finding.confidence, 0.0);
}

TEST(DecideEpisode, ALossOfNearlyAllTorqueIsAFreeJoint) {
  const Model model = hand_made_rrp({kLoss1, 0.9}, {kLoss1, 0.9});
  const auto named = [&](double share) {
    return decide_episode({episode_of_fault(model, kLoss1, 100.0, share), {}}, model, empty_base(model))
        .label;
  };
  EXPECT_EQ(named(0.95), kFree1);
  EXPECT_EQ(named(0.901), kFree1);
  EXPECT_EQ(named(0.89), kLoss1);
}

TEST(DecideEpisode, ALossOfNearlyAllTorqueIsAFreeJointByLikelihoodToo) {
  const Model model = hand_made_rrp({kBias3, 0.9}, {kDrift1, 0.9});
  EpisodeEvidence episode = episode_of_fault(model, kLoss1, 100.0, 0.96);
  explain(episode, model, kFree1, 98.0);
  const FaultFinding finding = decide_episode({episode, {}}, model, empty_base(model));
  EXPECT_EQ(finding.label, kFree1) << "the two names of one fault do not compete";
  EXPECT_EQ(finding.decided_by, DecidedBy::evidence);
}

TEST(DecideEpisode, ANameByLikelihoodBringsItsOwnConfidence) {
  const Model model = hand_made_rrp({kBias3, 0.9}, {kLocked2, 0.5});
  EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  explain(episode, model, kStuck2, 99.0);
  const FaultFinding finding = decide_episode({episode, {}}, model, empty_base(model));
  ASSERT_EQ(finding.decided_by, DecidedBy::evidence);
  EXPECT_NEAR(finding.confidence, 1.0 / (1.0 + std::exp(-1.0)), 1e-9) << "one nat ahead of one other label";
}

TEST(DecideEpisode, ANameByLikelihoodKeepsNoWarningOfTheNameItReplaced) {
  const Model model = hand_made_rrp({kBias3, 0.6}, {kDrift1, 0.6});
  const EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  CaseBase base = base_of(model, episode, kUnknown, 1);
  base.reject(1, kUnknown);
  const FaultFinding finding = decide_episode({episode, {}}, model, base);
  ASSERT_EQ(finding.label, kLocked2) << "even votes leave it to the likelihood";
  EXPECT_EQ(item(finding, "warning"), nullptr) << "that `unknown` was wrong once says nothing of locked";
}

TEST(DecideEpisode, ARejectionOfTheNameByLikelihoodWarns) {
  const Model model = hand_made_rrp({kBias3, 0.6}, {kDrift1, 0.6});
  const EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  CaseBase base = base_of(model, episode, kLocked2, 1);
  base.reject(1, kUnknown);
  const FaultFinding finding = decide_episode({episode, {}}, model, base);
  ASSERT_EQ(finding.decided_by, DecidedBy::evidence);
  ASSERT_NE(item(finding, "warning"), nullptr);
  EXPECT_NE(item(finding, "warning")->text.find("also called locked at joint 2"), std::string::npos);
}

TEST(DecideEpisode, AFreeJointByTheSizeOfItsLossSaysSo) {
  const Model model = hand_made_rrp({kLoss1, 0.9}, {kLoss1, 0.7});
  const EpisodeEvidence episode = episode_of_fault(model, kLoss1, 100.0, 0.97);
  const FaultFinding finding = decide_episode({episode, {}}, model, base_of(model, episode, kLoss1, 3));
  ASSERT_EQ(finding.label, (FaultLabel{FaultKind::free_swinging, 1}));
  EXPECT_EQ(
      item(finding, "decision")->text,
      "both networks say torque_loss at joint 1, and nearly all of it is lost: free_swinging at joint 1");
  EXPECT_NEAR(finding.confidence, 0.8, 1e-12);
  EXPECT_EQ(item(finding, "warning"), nullptr) << "cases of the loss are no contradiction";
}

TEST(DecideEpisode, TheNextCheckIsForTheNameGiven) {
  const Model model = hand_made_rrp({kLoss1, 0.9}, {kLoss1, 0.9});
  const auto check = [&](double share) {
    return decide_episode({episode_of_fault(model, kLoss1, 100.0, share), {}}, model, empty_base(model))
        .next_check;
  };
  EXPECT_FALSE(check(0.5).empty());
  EXPECT_NE(check(0.95), check(0.5));
}

}  // namespace
}  // namespace faultline
