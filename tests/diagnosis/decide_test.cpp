// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/core/random.hpp"
#include "lib/diagnosis/decision.hpp"
#include "lib/diagnosis/decision_words.hpp"
#include "tests/cases/example_base.hpp"

namespace faultline {
namespace {

constexpr FaultLabel kUnknown{FaultKind::unknown, 0};

Episode episode_at(double a, double b, Opinion mlp, Opinion rbfn) {
  return {.features = {a, b, 0.0}, .mlp = mlp, .rbfn = rbfn, .evidence = 30.0};
}

Decision decided(const Episode& episode, const CaseBase& base, const DecisionOptions& options = {}) {
  return decide({{}, episode, votes_on(episode, base, options.votes)}, options);
}

std::vector<std::string> warnings(const Episode& episode, const CaseBase& base) {
  return warnings_of_cases(decided(episode, base), votes_on(episode, base));
}

TEST(Decide, AgreementIsBelievedAndCasesArePrecedents) {
  const CaseBase base = example_base();
  const Episode episode = episode_at(2, 0, {kLocked, 0.9}, {kLocked, 0.7});
  const Decision decision = decided(episode, base);
  EXPECT_EQ(decision.label, kLocked);
  EXPECT_EQ(decision.decided_by, DecidedBy::agreement);
  EXPECT_NEAR(decision.confidence, 0.8, 1e-12);
  const Votes votes = votes_on(episode, base);
  ASSERT_FALSE(votes.precedents.empty());
  EXPECT_EQ(votes.precedents[0].found->label, kLocked);
  EXPECT_TRUE(warnings(episode, base).empty());
}

TEST(Decide, CasesWarnWhenTheyContradictAnAgreement) {
  const CaseBase base = example_base();
  const Episode episode = episode_at(0, 2, {kLocked, 0.9}, {kLocked, 0.7});
  EXPECT_EQ(decided(episode, base).label, kLocked);
  const auto said = warnings(episode, base);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("sensor_bias at joint 3"), std::string::npos) << said[0];
}

TEST(Decide, ARejectedPrecedentWarns) {
  CaseBase base = example_base();
  base.reject(2, kBias);  // the first case of kLocked
  const Episode episode{
      .features = base.at(2).episode.features, .mlp = {kLocked, 0.9}, .rbfn = {kLocked, 0.9}, .evidence = 30};
  EXPECT_EQ(decided(episode, base).label, kLocked);
  const auto said = warnings(episode, base);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("case 2"), std::string::npos) << said[0];
}

/// What a fault leaves that explains all, or a fault that is another one.
Surprise left_over(bool white) {
  Random random(4);
  Surprise surprise;
  for (int k = 0; k < 1000; ++k) surprise.add(0, (white ? 1.0 : 2.0) * random.normal(), 0.0, false);
  return surprise;
}

/// Both networks say kLocked; the evidence is for kBias by a little.
Decision decided_with(bool locked_is_white, bool bias_is_white) {
  const CaseBase base = example_base();
  const Episode episode = episode_at(2, 0, {kLocked, 0.9}, {kLocked, 0.7});
  const std::vector<LabelEvidence> evidence = {{kLocked, 40.0, {}, left_over(locked_is_white)},
                                               {kBias, 45.0, {}, left_over(bias_is_white)},
                                               {{FaultKind::unknown, 1}, 80.0, {}, left_over(true)}};
  return decide({evidence, episode, votes_on(episode, base), left_over(true)});
}

/// Both networks say kLocked, whose likelihood is `locked_nats`; that of kBias is 30. The alarm is at 18.
Decision decided_at_alarm(double locked_nats, double bias_nats = 30.0) {
  const CaseBase base = example_base();
  const Episode episode = episode_at(2, 0, {kLocked, 0.9}, {kLocked, 0.7});
  DecisionBasis basis{{{kLocked, locked_nats, {}, left_over(true)}, {kBias, bias_nats, {}, left_over(true)}},
                      episode,
                      votes_on(episode, base),
                      left_over(true)};
  basis.threshold = 18.0;
  return decide(basis);
}

TEST(Decide, ANameWhoseOwnLikelihoodWouldHaveRaisedNoAlarmGivesWayToOneThatDid) {
  EXPECT_EQ(decided_at_alarm(18.5).label, kLocked);
  const Decision decision = decided_at_alarm(17.5);
  EXPECT_EQ(decision.label, kBias);
  EXPECT_EQ(decision.reason, DecisionReason::lacks_evidence);
  EXPECT_EQ(decided_at_alarm(17.5, 27.0).label.kind, FaultKind::none) << "none stands out";
  EXPECT_EQ(decided_at_alarm(17.5, 17.9).label.kind, FaultKind::none);
}

/// Both networks say that joint 2 swings freely; being locked is nearly as likely.
Decision decided_of_joint_2(bool is_held) {
  const CaseBase base = example_base();
  const FaultLabel free{FaultKind::free_swinging, 2}, lost{FaultKind::torque_loss, 2},
      locked{FaultKind::locked, 2};
  const Episode episode = episode_at(2, 0, {free, 0.9}, {free, 0.9});
  DecisionBasis basis{{{free, 60.0, {}, left_over(true)},
                       {lost, 59.0, {0.95, 0.0}, left_over(true)},
                       {locked, 55.0, {}, left_over(true)}},
                      episode,
                      votes_on(episode, base),
                      left_over(true)};
  basis.is_held[1] = is_held;
  return decide(basis);
}

TEST(Decide, AJointThatStandsStillUnderTorqueIsNotFree) {
  EXPECT_EQ(decided_of_joint_2(false).label, (FaultLabel{FaultKind::free_swinging, 2}));
  const Decision held = decided_of_joint_2(true);
  EXPECT_EQ(held.label, (FaultLabel{FaultKind::locked, 2}));
  EXPECT_EQ(held.reason, DecisionReason::joint_is_held);
}

TEST(Decide, ANameThatLeavesNoiseStands) {
  EXPECT_EQ(decided_with(true, true).label, kLocked);
  EXPECT_EQ(decided_with(true, false).label, kLocked);
  EXPECT_EQ(decided_with(true, false).decided_by, DecidedBy::agreement);
}

TEST(Decide, ANameThatLeavesMoreThanNoiseGivesWayToTheLikeliestFaultThatDoesNot) {
  const Decision decision = decided_with(false, true);
  EXPECT_EQ(decision.label, kBias);
  EXPECT_EQ(decision.decided_by, DecidedBy::evidence);
  EXPECT_EQ(decision.reason, DecisionReason::others_refuted);
  EXPECT_GT(decision.confidence, 0.9) << "among the known ones";
}

TEST(Decide, WhereEveryKnownFaultLeavesMoreThanNoiseTheFaultIsUnknown) {
  const Decision decision = decided_with(false, false);
  EXPECT_EQ(decision.label, kUnknown);
  EXPECT_EQ(decision.reason, DecisionReason::all_refuted);
  EXPECT_GT(decision.confidence, 0.5);
}

TEST(Decide, AStuckEncoderIsNotRefutedByWhatOtherJointsMiss) {
  const CaseBase base = example_base();
  const FaultLabel stuck{FaultKind::stuck_encoder, 2};
  const Episode episode = episode_at(2, 0, {stuck, 0.9}, {stuck, 0.7});
  const std::vector<LabelEvidence> evidence = {{stuck, 40.0, {}, left_over(false)}};
  EXPECT_EQ(decide({evidence, episode, votes_on(episode, base), left_over(true)}).label, stuck);
}

TEST(Decide, CasesSettleADisagreement) {
  const CaseBase base = example_base();
  const Decision first = decided(episode_at(0, 2, {kBias, 0.5}, {kFree, 0.9}), base);
  EXPECT_EQ(first.label, kBias);
  EXPECT_EQ(first.decided_by, DecidedBy::cases);
  EXPECT_GT(first.confidence, 0.5);
  const Decision second = decided(episode_at(0, 0, {kBias, 0.9}, {kFree, 0.5}), base);
  EXPECT_EQ(second.label, kFree);
}

TEST(Decide, CasesMayNameWhatNoNetworkNamed) {
  const CaseBase base = example_base();
  const Episode episode = episode_at(0, 2, {kLocked, 0.5}, {kFree, 0.5});
  EXPECT_EQ(decided(episode, base).label, kBias);
  EXPECT_EQ(votes_on(episode, base).shares[0].label, kBias);
}

TEST(Decide, NothingNearIsAnUnknownFault) {
  const CaseBase base = example_base();
  const Episode episode = episode_at(40, -40, {kBias, 0.9}, {kFree, 0.9});
  const Decision decision = decided(episode, base);
  EXPECT_EQ(decision.label, kUnknown);
  EXPECT_EQ(decision.decided_by, DecidedBy::cases);
  EXPECT_EQ(decision.reason, DecisionReason::nothing_similar);
  EXPECT_TRUE(votes_on(episode, base).precedents.empty());
}

TEST(Decide, ThinEvidenceAbstains) {
  const CaseBase base = example_base();
  Episode episode = episode_at(2, 0, {kLocked, 0.9}, {kLocked, 0.9});
  episode.evidence = 1.0;
  EXPECT_EQ(decided(episode, base).decided_by, DecidedBy::abstained);
  EXPECT_EQ(decided(episode, base).label, kUnknown);
  EXPECT_EQ(decided(episode, base, {.thin_evidence = 0.5}).decided_by, DecidedBy::agreement);
  const Decision unsure = decided(episode_at(2, 0, {kLocked, 0.1}, {kLocked, 0.1}), base);
  EXPECT_EQ(unsure.decided_by, DecidedBy::abstained);
  EXPECT_EQ(unsure.reason, DecisionReason::hardly_believed);
}

TEST(Decide, EvenVotesAbstain) {
  const CaseBase base = example_base();
  const DecisionOptions options{.votes = {.neighbours = 1, .opinion_weight = 1.0}};
  const Decision decision = decided(episode_at(0, 0, {kBias, 1.0}, {kLocked, 1.0}), base, options);
  EXPECT_EQ(decision.decided_by, DecidedBy::abstained);
  EXPECT_EQ(decision.confidence, 0.0);
}

TEST(Decide, UnconfirmedCasesCountLess) {
  CaseBase base({"a", "b", "noise"});
  Random random(1);
  Case c = example_case(random, kFree, 0, 0);
  c.outcome = CaseOutcome::unconfirmed;
  base.retain(c);
  const Episode episode{
      .features = c.episode.features, .mlp = {kBias, 0.7}, .rbfn = {kFree, 0.1}, .evidence = 30.0};
  EXPECT_EQ(decided(episode, base).label, kBias);
  base.confirm(1);
  EXPECT_EQ(decided(episode, base).label, kFree);
}

TEST(Votes, SharesSumToOneAndDoNotDependOnTheRun) {
  const CaseBase base = example_base();
  const Episode episode = episode_at(1, 1, {kBias, 0.4}, {kLocked, 0.4});
  const Votes a = votes_on(episode, base, {.near_similarity = 0.0}),
              b = votes_on(episode, base, {.near_similarity = 0.0});
  double sum = 0.0;
  for (const LabelShare& s : a.shares) sum += s.share;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  ASSERT_EQ(a.shares.size(), b.shares.size());
  for (std::size_t i = 0; i < a.shares.size(); ++i) EXPECT_EQ(a.shares[i].share, b.shares[i].share);
}

TEST(Decide, APushThatGoesOnForLongIsUnknown) {
  const FaultLabel push{FaultKind::collision, 1};
  DecisionBasis basis;
  basis.episode = episode_at(2, 0, {push, 0.9}, {push, 0.9});
  basis.lasts_s = 0.4;
  EXPECT_EQ(decide(basis).label, push);
  basis.lasts_s = 26.0;
  const Decision decision = decide(basis);
  EXPECT_EQ(decision.label, kUnknown);
  EXPECT_EQ(reason_in_words(decision, basis), "it begins as collision at joint 1, but goes on for 26 s");
}

}  // namespace
}  // namespace faultline
