// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/core/random.hpp"
#include "lib/diagnose/decision.hpp"
#include "tests/cases/example_base.hpp"

namespace faultline {
namespace {

Episode episode_at(double a, double b, Opinion mlp, Opinion rbfn) {
  return {.features = {a, b, 0.0}, .mlp = mlp, .rbfn = rbfn, .evidence = 30.0};
}

Decision decided(const Episode& episode, const CaseBase& base, const VoteOptions& options = {}) {
  return opinion_on(episode, votes_on(episode, base, options));
}

std::vector<std::string> warnings(const Episode& episode, const CaseBase& base) {
  return warnings_of_cases(decided(episode, base), votes_on(episode, base));
}

TEST(Decide, NetworksThatAgreeDecideAndCasesArePrecedents) {
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
  EXPECT_NE(said[0].find("the position sensor of joint 3 reads a shifted position"), std::string::npos)
      << said[0];
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

/// Both networks say kLocked; the log says `likeliest`, and `as_likely` explain it alike.
Decision decided_with(const FaultLabel& likeliest, const std::vector<FaultLabel>& as_likely) {
  const CaseBase base = example_base();
  const Episode episode = episode_at(2, 0, {kLocked, 0.9}, {kLocked, 0.7});
  return decide({likeliest, as_likely, {{kLocked, 40.0}, {kBias, 45.0}}, episode, votes_on(episode, base)});
}

TEST(Decide, NetworksChooseAmongTheFaultsThatExplainTheLog) {
  EXPECT_EQ(decided_with(kLocked, {}).decided_by, DecidedBy::agreement);
  const Decision decision = decided_with(kBias, {kLocked});
  EXPECT_EQ(decision.label, kLocked);
  EXPECT_EQ(decision.decided_by, DecidedBy::agreement);
}

TEST(Decide, AFaultThatTheLogExcludesGivesWayToTheLikeliest) {
  const Decision decision = decided_with(kBias, {});
  EXPECT_EQ(decision.label, kBias);
  EXPECT_EQ(decision.decided_by, DecidedBy::evidence);
  EXPECT_EQ(decision.reason, DecisionReason::log_excludes);
  EXPECT_EQ(decision.voted, kLocked);
  EXPECT_GT(decision.confidence, 0.9);
}

TEST(Decide, AFaultThatNoKnownKindExplainsIsUnknown) {
  const Decision decision = decided_with({FaultKind::unknown, 2_joint}, {kLocked});
  EXPECT_EQ(decision.label, (FaultLabel{FaultKind::unknown, Joint()}));
  EXPECT_EQ(decision.reason, DecisionReason::no_known_form);
  EXPECT_GT(decision.confidence, 0.5);
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

TEST(Decide, CasesMayNameAFaultThatNoNetworkNamed) {
  const CaseBase base = example_base();
  const Episode episode = episode_at(0, 2, {kLocked, 0.5}, {kFree, 0.5});
  EXPECT_EQ(decided(episode, base).label, kBias);
  EXPECT_EQ(votes_on(episode, base).shares[0].label, kBias);
}

TEST(Decide, ADisagreementWithoutSimilarCasesStaysUndecided) {
  const CaseBase base = example_base();
  const Episode episode = episode_at(40, -40, {kBias, 0.9}, {kFree, 0.9});
  EXPECT_EQ(decided(episode, base).label.kind, FaultKind::none);
  EXPECT_TRUE(votes_on(episode, base).precedents.empty());
}

TEST(Decide, NetworksThatAgreeWithLowConfidenceAbstain) {
  const Decision unsure = decided(episode_at(2, 0, {kLocked, 0.1}, {kLocked, 0.1}), example_base());
  EXPECT_EQ(unsure.label.kind, FaultKind::none);
  EXPECT_EQ(unsure.decided_by, DecidedBy::abstained);
}

TEST(Decide, EqualVotesDecideNothing) {
  const CaseBase base = example_base();
  const VoteOptions options{.neighbours = 1, .opinion_weight = 1.0};
  const Decision decision = decided(episode_at(0, 0, {kBias, 1.0}, {kLocked, 1.0}), base, options);
  EXPECT_EQ(decision.label.kind, FaultKind::none);
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
  const Episode episode = episode_at(2, 0, {kBias, 0.4}, {kLocked, 0.4});
  const Votes a = votes_on(episode, base), b = votes_on(episode, base);
  ASSERT_FALSE(a.precedents.empty());
  double sum = 0.0;
  for (const LabelShare& s : a.shares) sum += s.share;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  ASSERT_EQ(a.shares.size(), b.shares.size());
  for (std::size_t i = 0; i < a.shares.size(); ++i) EXPECT_EQ(a.shares[i].share, b.shares[i].share);
}

}  // namespace
}  // namespace faultline
