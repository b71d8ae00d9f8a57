// SPDX-License-Identifier: MIT
#include "lib/cases/case_base.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lib/core/error.hpp"
#include "tests/cases/example_base.hpp"

namespace faultline {
namespace {

TEST(CaseBase, RetainGivesAscendingIds) {
  CaseBase base({"a", "b", "noise"});
  Random random(1);
  EXPECT_EQ(base.retain(example_case(random, kFree, 0, 0)), 1);
  EXPECT_EQ(base.retain(example_case(random, kFree, 0, 0)), 2);
  EXPECT_EQ(base.at(2).id, 2);
  EXPECT_THROW(base.at(3), Error);
}

TEST(CaseBase, RefusesOtherOrInfiniteFeatures) {
  CaseBase base({"a", "b", "noise"});
  Case c;
  c.episode.features = {1.0, 2.0};
  EXPECT_THROW(base.retain(c), Error);
  c.episode.features = {1.0, 2.0, std::numeric_limits<double>::infinity()};
  EXPECT_THROW(base.retain(c), Error);
  c.episode.features = {1.0, 2.0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(base.retain(c), 1);
  EXPECT_EQ(base.cases().size(), 1u);
}

TEST(CaseBase, RefusesEmptyAndRepeatedFeatureNames) {
  EXPECT_THROW(CaseBase({"a", "a"}), Error);
  EXPECT_THROW(CaseBase({""}), Error);
}

TEST(CaseBase, RefusesIdsThatDoNotAscend) {
  const CaseBase base = example_base(2);
  std::vector<Case> cases = base.cases();
  std::swap(cases[0], cases[1]);
  EXPECT_THROW(CaseBase(base.metric(), cases), Error);
}

TEST(CaseBase, ConfirmAndRejectReviseOneCase) {
  CaseBase base = example_base(2);
  base.confirm(1, {}, "tightened the belt");
  base.confirm(2, kBias);
  base.reject(3);
  base.reject(4, kLocked, "nothing");
  EXPECT_EQ(base.at(1).label, kFree);
  EXPECT_EQ(base.at(1).what_was_done, "tightened the belt");
  EXPECT_EQ(base.at(2).label, kBias);
  EXPECT_EQ(base.at(2).decision, kLocked);
  EXPECT_EQ(base.at(3).label.kind, FaultKind::unknown);
  EXPECT_EQ(base.at(4).outcome, CaseOutcome::rejected);
  EXPECT_EQ(base.at(4).label, kLocked);
  base.confirm(1);
  EXPECT_EQ(base.at(1).what_was_done, "tightened the belt") << "an empty note keeps the old one";
  base.confirm(4);
  EXPECT_EQ(base.at(4).label, kFree) << "confirming without a label confirms the decision";
}

TEST(CaseBase, InvalidBytesInTextsAreReplaced) {
  CaseBase base({"a", "b", "noise"});
  Random random(1);
  Case c = example_case(random, kFree, 0, 0);
  c.origin = "run\xff.csv";
  base.retain(c);
  EXPECT_EQ(base.at(1).origin, "run\xef\xbf\xbd.csv");
}

TEST(CaseBase, ContentHashDependsOnEveryField) {
  const CaseBase base = example_base(2);
  EXPECT_EQ(base.sha256(), example_base(2).sha256());
  const auto differs = [&](auto change) {
    std::vector<Case> cases = base.cases();
    change(cases[2]);
    return CaseBase(base.metric(), cases).sha256() != base.sha256();
  };
  EXPECT_TRUE(differs([](Case& c) { c.episode.features[1] += 1e-12; }));
  EXPECT_TRUE(differs([](Case& c) { c.episode.mlp.confidence = 0.1; }));
  EXPECT_TRUE(differs([](Case& c) { c.episode.rbfn.label.joint = 9_joint; }));
  EXPECT_TRUE(differs([](Case& c) { c.episode.evidence = 1; }));
  EXPECT_TRUE(differs([](Case& c) { c.decision = kFree; }));
  EXPECT_TRUE(differs([](Case& c) { c.label = kFree; }));
  EXPECT_TRUE(differs([](Case& c) { c.outcome = CaseOutcome::rejected; }));
  EXPECT_TRUE(differs([](Case& c) { c.what_was_done = "x"; }));
  EXPECT_TRUE(differs([](Case& c) { c.origin = "x"; }));
  EXPECT_TRUE(differs([](Case& c) { c.log_sha256 = "x"; }));
  EXPECT_TRUE(differs([](Case& c) { c.onset_s = 1.5; }));
  EXPECT_TRUE(differs([](Case& c) { c.features_by = "x"; }));
  EXPECT_TRUE(differs([](Case& c) { c.log_name = "x"; }));
  EXPECT_TRUE(differs([](Case& c) { c.robot = "x"; }));
  EXPECT_TRUE(differs([](Case& c) { c.person = "x"; }));
  EXPECT_TRUE(differs([](Case& c) { c.date = "2026-03-02"; }));
  for (const CaseRobot& robot : {CaseRobot{"bench", ""}, CaseRobot{"", "RRP"}}) {
    CaseBase other = base;
    other.describe_robot(robot);
    EXPECT_NE(other.sha256(), base.sha256());
  }
  Metric metric = base.metric();
  metric.near_similarity *= 0.5;
  EXPECT_NE(CaseBase(metric, base.cases()).sha256(), base.sha256());
}

TEST(CaseBase, MergeAddsOnlyNewCases) {
  CaseBase base = example_base(2), other = example_base(3), of_others({"a", "b"});
  for (CaseBase* each : {&base, &other, &of_others}) each->describe_robot({"bench", "RRP"});
  EXPECT_EQ(base.merge(other).added, 3);
  EXPECT_EQ(base.cases().size(), 9u);
  EXPECT_EQ(base.merge(other).added, 0);
  EXPECT_THROW(base.merge(of_others), Error);
}

TEST(CaseBase, MergeMarksTheFeaturesOfAnotherModel) {
  CaseBase base = example_base(2), other = example_base(3);
  base.belong_to("one");
  other.belong_to("two");
  for (CaseBase* each : {&base, &other}) each->describe_robot({"bench", "RRP"});
  EXPECT_EQ(base.merge(other).added, 9);
  EXPECT_EQ(base.cases().back().features_by, "two");
  EXPECT_EQ(base.cases().front().features_by, "");
  EXPECT_EQ(base.merge(other).added, 0);
}

TEST(CaseBase, LearnLeavesOutCasesOfUnknownFault) {
  CaseBase base = example_base(10), with_rejected = example_base(10);
  Random random(3);
  with_rejected.reject(with_rejected.retain(example_case(random, kFree, 50.0, 50.0)));
  base.learn();
  with_rejected.learn();
  EXPECT_EQ(base.metric().features, with_rejected.metric().features);
}

Case seen_case(double onset_s = 12.5) {
  Random random(1);
  Case c = example_case(random, kLocked, 2.0, 0.0);
  c.outcome = CaseOutcome::unconfirmed;
  c.origin = "night.csv";
  c.log_sha256 = "abcd";
  c.onset_s = onset_s;
  c.date = "2026-03-01";
  return c;
}

CaseBase base_of(const std::string& robot, const std::string& axes = "RRP") {
  CaseBase base = example_base(2);
  base.belong_to("model of " + robot);
  base.describe_robot({robot, axes});
  return base;
}

TEST(SameEvent, HasTheSameLogOnsetAndName) {
  const Case c = seen_case();
  EXPECT_TRUE(is_same_event(c, seen_case(12.55))) << "another model estimates the onset anew";
  EXPECT_FALSE(is_same_event(c, seen_case(13.0)));
  EXPECT_FALSE(is_same_event(c, seen_case(std::numeric_limits<double>::quiet_NaN())));
  Case other = c;
  other.log_sha256 = "ef";
  EXPECT_FALSE(is_same_event(c, other));
  other = c;
  other.label = kBias;
  EXPECT_TRUE(is_same_event(c, other)) << "a person corrected it";
  other.decision = kBias;
  EXPECT_FALSE(is_same_event(c, other)) << "another joint at the same time";
  Case unknown = c;
  unknown.log_sha256 = "";
  EXPECT_FALSE(is_same_event(unknown, unknown)) << "no evidence shows that they are the same event";
}

TEST(MergeCases, AnotherKindOfRobotIsRefused) {
  CaseBase base = base_of("bench", "RRP");
  try {
    base.merge(base_of("gantry", "PPR"));
    FAIL() << "it was merged";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(error.message().find("PPR"), std::string::npos) << error.message();
  }
}

TEST(MergeCases, AJointThatTheRobotLacksIsRefused) {
  CaseBase base = base_of("bench", "RRP"), other = base_of("bench 7", "RRP");
  other.reject(1, FaultLabel{FaultKind::locked, 7_joint});
  EXPECT_THROW(base.merge(other), Error);
}

TEST(MergeCases, ASecondMergeOfTheSameBaseAddsNothing) {
  CaseBase base = base_of("bench"), other = base_of("bench 7");
  other.retain(seen_case());
  EXPECT_EQ(base.merge(other).added, 7);
  EXPECT_EQ(base.cases().back().robot, "bench 7") << "whose it is stays known";
  EXPECT_EQ(base.cases().back().features_by, "model of bench 7");
  const std::string before = base.sha256();
  const MergedCases again = base.merge(other);
  EXPECT_EQ(again.added + again.updated, 0);
  EXPECT_EQ(base.sha256(), before);
}

TEST(MergeCases, MergingBackAMergedBaseAddsNothing) {
  CaseBase base = base_of("bench"), other = base_of("bench 7");
  base.retain(seen_case());
  Case by_hand = seen_case();
  by_hand.log_sha256 = "";
  base.retain(by_hand);
  other.merge(base);
  const std::size_t before = base.cases().size();
  CaseBase only_ours = other;
  for (std::int64_t id = 1; id <= 6; ++id) only_ours.remove(id);
  const MergedCases back = base.merge(only_ours);
  EXPECT_EQ(back.added, 0);
  EXPECT_EQ(base.cases().size(), before);
}

TEST(MergeCases, ALaterDecisionReplacesAnEarlierOne) {
  CaseBase base = base_of("bench"), other = base_of("bench 7");
  const auto id = base.retain(seen_case());
  other.confirm(other.retain(seen_case()), kBias, "new encoder", {"A. Weber", "2026-03-02"});
  EXPECT_EQ(base.merge(other).updated, 1);
  EXPECT_EQ(base.at(id).label, kBias);
  EXPECT_EQ(base.at(id).person, "A. Weber");
  EXPECT_EQ(base.at(id).what_was_done, "new encoder");
  CaseBase older = base_of("bench 7");
  older.confirm(older.retain(seen_case()), kLocked, "", {"B. Lang", "2026-02-01"});
  EXPECT_EQ(base.merge(older).updated, 0) << "the later word stands";
  EXPECT_EQ(base.at(id).label, kBias);
}

}  // namespace
}  // namespace faultline
