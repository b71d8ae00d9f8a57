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

TEST(CaseBase, RefusesFeatureNamesThatAreEmptyOrTwice) {
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

TEST(CaseBase, TextsBecomeUtf8) {
  CaseBase base({"a", "b", "noise"});
  Random random(1);
  Case c = example_case(random, kFree, 0, 0);
  c.origin = "run\xff.csv";
  base.retain(c);
  EXPECT_EQ(base.at(1).origin, "run\xef\xbf\xbd.csv");
}

TEST(CaseBase, ContentHashSeesEveryField) {
  const CaseBase base = example_base(2);
  EXPECT_EQ(base.sha256(), example_base(2).sha256());
  const auto differs = [&](auto change) {
    std::vector<Case> cases = base.cases();
    change(cases[2]);
    return CaseBase(base.metric(), cases).sha256() != base.sha256();
  };
  EXPECT_TRUE(differs([](Case& c) { c.episode.features[1] += 1e-12; }));
  EXPECT_TRUE(differs([](Case& c) { c.episode.mlp.confidence = 0.1; }));
  EXPECT_TRUE(differs([](Case& c) { c.episode.rbfn.label.joint = 9; }));
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

TEST(CaseBase, MergeAddsOnlyWhatIsNew) {
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

}  // namespace
}  // namespace faultline
