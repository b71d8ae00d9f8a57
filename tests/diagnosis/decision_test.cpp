// SPDX-License-Identifier: MIT
#include "lib/diagnosis/decision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lib/fault/fault_words.hpp"
#include "tests/cases/example_base.hpp"

namespace faultline {
namespace {

TEST(FaultWords, EveryKindHasItsOwnWordsAndCheck) {
  std::set<std::string> names, checks;
  for (int kind = 0; kind < kFaultKinds; ++kind) {
    const FaultLabel label{static_cast<FaultKind>(kind), 3};
    names.insert(plain_name(label.kind));
    checks.insert(next_check_for(label));
    EXPECT_EQ(plain_words(label).rfind("joint 3 ", 0), 0u) << plain_words(label);
    EXPECT_EQ(next_check_for(label).find('{'), std::string::npos);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kFaultKinds));
  EXPECT_EQ(checks.size(), static_cast<std::size_t>(kFaultKinds));
}

TEST(FaultWords, LikenessGoesBothWaysAndKnowsJoints) {
  const FaultLabel locked{FaultKind::locked, 3}, stuck{FaultKind::stuck_encoder, 3},
      other{FaultKind::stuck_encoder, 1};
  EXPECT_NE(why_alike(locked, stuck), "");
  EXPECT_EQ(why_alike(locked, stuck), why_alike(stuck, locked));
  EXPECT_EQ(why_alike(locked, other), "");
  EXPECT_NE(why_alike({FaultKind::payload_change, 0}, {FaultKind::torque_loss, 3}), "");
}

TEST(Decision, AFindingTakesWhatTheCasesDecided) {
  const CaseBase base = example_base();
  const Episode episode{
      .features = {0.0, 2.0, 0.0}, .mlp = {kBias, 0.6}, .rbfn = {kFree, 0.7}, .evidence = 50.0};
  FaultFinding finding;
  finding.onset_s = 1.5;
  finding.evidence = {{"log_likelihood_ratio", 50.0, "", ""}};
  apply_decision(finding, episode, base, decide(episode, base));
  EXPECT_EQ(finding.label, kBias);
  EXPECT_EQ(finding.onset_s, 1.5);
  EXPECT_EQ(finding.decided_by, DecidedBy::cases);
  EXPECT_EQ(finding.rbfn.label, kFree);
  ASSERT_FALSE(finding.precedents.empty());
  EXPECT_EQ(finding.precedents[0].label, kBias);
  ASSERT_EQ(finding.could_also_be.size(), 1u);
  EXPECT_EQ(finding.could_also_be[0].label, kFree);
  EXPECT_EQ(finding.evidence[0].name, "log_likelihood_ratio");
  EXPECT_EQ(finding.next_check, next_check_for(kBias));
  ASSERT_EQ(finding.episode.features.size(), 3u);
  EXPECT_EQ(finding.episode.features[1], (std::pair<std::string, double>("b", 2.0)));
}

TEST(Decision, WarningsOfTheCasesBecomeEvidence) {
  const CaseBase base = example_base();
  const Episode episode{
      .features = {0.0, 2.0, 0.0}, .mlp = {kLocked, 0.9}, .rbfn = {kLocked, 0.9}, .evidence = 50.0};
  FaultFinding finding;
  apply_decision(finding, episode, base, decide(episode, base));
  EXPECT_EQ(finding.label, kLocked);
  EXPECT_TRUE(std::any_of(finding.evidence.begin(), finding.evidence.end(),
                          [](const EvidenceItem& item) { return item.name == "warning"; }));
  EXPECT_TRUE(std::any_of(finding.could_also_be.begin(), finding.could_also_be.end(),
                          [](const Alternative& a) { return a.label == kBias; }));
}

TEST(Decision, AlternativesAreListedOnceAndNeverTheLabelItself) {
  FaultFinding finding;
  finding.label = kLocked;
  add_alternative(finding, kLocked);
  add_alternative(finding, {FaultKind::stuck_encoder, 2});
  add_alternative(finding, {FaultKind::stuck_encoder, 2}, "again");
  ASSERT_EQ(finding.could_also_be.size(), 1u);
  EXPECT_EQ(finding.could_also_be[0].why, why_alike(kLocked, {FaultKind::stuck_encoder, 2}));
}

TEST(Decision, FaultsAreOrderedByOnsetWithUnknownTimesLast) {
  Diagnosis diagnosis;
  diagnosis.faults.resize(3);
  diagnosis.faults[1].onset_s = 2.0;
  diagnosis.faults[2].onset_s = 1.0;
  order_faults(diagnosis);
  EXPECT_EQ(diagnosis.faults[0].onset_s, 1.0);
  EXPECT_EQ(diagnosis.faults[1].onset_s, 2.0);
  EXPECT_EQ(diagnosis.faults[2].id, 3);
  EXPECT_EQ(diagnosis.verdict, Verdict::faulty);
}

TEST(Decision, NoFaultsLeaveTheVerdictAlone) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::inconclusive;
  order_faults(diagnosis);
  EXPECT_EQ(diagnosis.verdict, Verdict::inconclusive);
}

}  // namespace
}  // namespace faultline
