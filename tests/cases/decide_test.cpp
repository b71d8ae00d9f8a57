// SPDX-License-Identifier: MIT
#include "lib/cases/decide.hpp"

#include <gtest/gtest.h>

#include "tests/cases/example_base.hpp"

namespace faultline {
namespace {

constexpr FaultLabel kUnknown{FaultKind::unknown, 0};

Episode episode_at(double a, double b, CaseOpinion mlp, CaseOpinion rbfn) {
  return {.features = {a, b, 0.0}, .mlp = mlp, .rbfn = rbfn, .evidence = 30.0};
}

TEST(Decide, AgreementIsBelievedAndCasesArePrecedents) {
  const CaseBase base = example_base();
  const CaseDecision decision = decide(episode_at(2, 0, {kLocked, 0.9}, {kLocked, 0.7}), base);
  EXPECT_EQ(decision.label, kLocked);
  EXPECT_EQ(decision.settled_by, Settlement::agreement);
  EXPECT_NEAR(decision.confidence, 0.8, 1e-12);
  ASSERT_FALSE(decision.precedents.empty());
  EXPECT_EQ(decision.precedents[0].found->label, kLocked);
  EXPECT_TRUE(decision.warnings.empty());
}

TEST(Decide, CasesWarnWhenTheyContradictAnAgreement) {
  const CaseBase base = example_base();
  const CaseDecision decision = decide(episode_at(0, 2, {kLocked, 0.9}, {kLocked, 0.7}), base);
  EXPECT_EQ(decision.label, kLocked);
  ASSERT_EQ(decision.warnings.size(), 1u);
  EXPECT_NE(decision.warnings[0].find("sensor_bias at joint 3"), std::string::npos) << decision.warnings[0];
}

TEST(Decide, ARejectedPrecedentWarns) {
  CaseBase base = example_base();
  base.reject(2, kBias);  // the first case of kLocked
  const CaseDecision decision = decide({.features = base.at(2).episode.features,
                                        .mlp = {kLocked, 0.9},
                                        .rbfn = {kLocked, 0.9},
                                        .evidence = 30},
                                       base);
  EXPECT_EQ(decision.label, kLocked);
  ASSERT_EQ(decision.warnings.size(), 1u);
  EXPECT_NE(decision.warnings[0].find("case 2"), std::string::npos) << decision.warnings[0];
}

TEST(Decide, CasesSettleADisagreement) {
  const CaseBase base = example_base();
  const CaseDecision first = decide(episode_at(0, 2, {kBias, 0.5}, {kFree, 0.9}), base);
  EXPECT_EQ(first.label, kBias);
  EXPECT_EQ(first.settled_by, Settlement::cases);
  EXPECT_GT(first.confidence, 0.5);
  const CaseDecision second = decide(episode_at(0, 0, {kBias, 0.9}, {kFree, 0.5}), base);
  EXPECT_EQ(second.label, kFree);
}

TEST(Decide, CasesMayNameWhatNoNetworkNamed) {
  const CaseDecision decision = decide(episode_at(0, 2, {kLocked, 0.5}, {kFree, 0.5}), example_base());
  EXPECT_EQ(decision.label, kBias);
  EXPECT_EQ(decision.shares[0].label, kBias);
}

TEST(Decide, NothingNearIsAnUnknownFault) {
  const CaseDecision decision = decide(episode_at(40, -40, {kBias, 0.9}, {kFree, 0.9}), example_base());
  EXPECT_EQ(decision.label, kUnknown);
  EXPECT_EQ(decision.settled_by, Settlement::cases);
  EXPECT_TRUE(decision.precedents.empty());
}

TEST(Decide, ThinEvidenceAbstains) {
  const CaseBase base = example_base();
  Episode episode = episode_at(2, 0, {kLocked, 0.9}, {kLocked, 0.9});
  episode.evidence = 1.0;
  EXPECT_EQ(decide(episode, base).settled_by, Settlement::abstained);
  EXPECT_EQ(decide(episode, base).label, kUnknown);
  EXPECT_EQ(decide(episode, base, {.thin_evidence = 0.5}).settled_by, Settlement::agreement);
  const CaseDecision unsure = decide(episode_at(2, 0, {kLocked, 0.1}, {kLocked, 0.1}), base);
  EXPECT_EQ(unsure.settled_by, Settlement::abstained);
}

TEST(Decide, EvenVotesAbstain) {
  CaseBase base = example_base();
  const CaseDecision decision =
      decide(episode_at(0, 0, {kBias, 1.0}, {kLocked, 1.0}), base, {.neighbours = 1, .opinion_weight = 1.0});
  EXPECT_EQ(decision.settled_by, Settlement::abstained);
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
  EXPECT_EQ(decide(episode, base).label, kBias);
  base.confirm(1);
  EXPECT_EQ(decide(episode, base).label, kFree);
}

TEST(Decide, SharesSumToOneAndDoNotDependOnTheRun) {
  const CaseBase base = example_base();
  const Episode episode = episode_at(1, 1, {kBias, 0.4}, {kLocked, 0.4});
  const CaseDecision a = decide(episode, base, {.near_similarity = 0.0}),
                     b = decide(episode, base, {.near_similarity = 0.0});
  double sum = 0.0;
  for (const LabelShare& s : a.shares) sum += s.share;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_EQ(a.why, b.why);
}

}  // namespace
}  // namespace faultline
