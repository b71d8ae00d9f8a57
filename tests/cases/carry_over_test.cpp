// SPDX-License-Identifier: MIT
#include "lib/cases/carry_over.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/cases/example_base.hpp"

namespace faultline {
namespace {

Case field_case(double x, const std::string& log = "night.csv") {
  Random random(1);
  Case c = example_case(random, kLocked, x, 0.5);
  c.origin = log;
  c.log_sha256 = "sha of " + log;
  c.onset_s = 12.5;
  c.what_was_done = "changed the brake relay";
  return c;
}

CaseBase base_of(const std::string& model, std::vector<std::string> features = {"a", "b", "noise"}) {
  CaseBase base(features);
  Random random(3);
  Case c = example_case(random, kFree, 0.0, 0.0);
  c.episode.features.assign(features.size(), 0.25);
  for (int i = 0; i < 3; ++i) base.retain(c);
  base.belong_to(model);
  return base;
}

TEST(CarryOver, AFieldCaseIsCarriedOverAndMarkedWithTheEarlierModel) {
  CaseBase old = base_of("old"), fresh = base_of("new");
  const auto id = old.retain(field_case(2.0));
  const CarriedCases count = carry_over(old, fresh);
  EXPECT_EQ(count.replaced, 3);
  EXPECT_EQ(count.carried, 1);
  EXPECT_EQ(count.old_features, 1);
  EXPECT_EQ(count.renumbered, 0);
  ASSERT_EQ(fresh.cases().size(), 4u);
  const Case& kept = fresh.at(id);
  EXPECT_EQ(kept.what_was_done, "changed the brake relay");
  EXPECT_EQ(kept.episode.features, old.at(id).episode.features);
  EXPECT_EQ(kept.features_by, "old");
  EXPECT_EQ(fresh.model_identity(), "new");
}

TEST(CarryOver, ARevisedSimulatedCaseIsCarriedOver) {
  CaseBase old = base_of("old"), fresh = base_of("new");
  old.reject(2, kBias);
  EXPECT_EQ(carry_over(old, fresh).carried, 1);
  EXPECT_EQ(fresh.cases().back().outcome, CaseOutcome::rejected);
  EXPECT_EQ(fresh.cases().back().id, 4) << "2 is taken";
}

TEST(CarryOver, ASignedCaseIsCarriedOverAlsoIfItsLabelIsUnchanged) {
  CaseBase old = base_of("old"), fresh = base_of("new");
  fresh.describe_robot({"bench", "RRP"});
  old.confirm(2, {}, "", {"A. Weber", "2026-03-02"});
  EXPECT_EQ(carry_over(old, fresh).carried, 1);
  EXPECT_EQ(fresh.cases().back().person, "A. Weber");
  EXPECT_EQ(fresh.robot().axes, "RRP");
}

TEST(CarryOver, FeaturesAreMatchedByName) {
  CaseBase old = base_of("old"), fresh = base_of("new", {"noise", "other", "a"});
  old.retain(field_case(2.0));
  carry_over(old, fresh);
  const std::vector<double>& before = old.cases().back().episode.features;
  const std::vector<double>& after = fresh.cases().back().episode.features;
  EXPECT_EQ(after[0], before[2]);
  EXPECT_TRUE(std::isnan(after[1]));
  EXPECT_EQ(after[2], before[0]);
}

TEST(CarryOver, ARepeatedFaultOfALabelledLogStaysOneCaseWithNewFeatures) {
  CaseBase old = base_of("old"), fresh = base_of("new");
  old.retain(field_case(2.0));
  Case labelled = field_case(7.0);
  labelled.origin = kLabelledOrigin;
  labelled.what_was_done.clear();
  fresh.retain(labelled);
  const CarriedCases count = carry_over(old, fresh);
  EXPECT_EQ(count.recomputed, 1);
  EXPECT_EQ(count.old_features, 0);
  ASSERT_EQ(fresh.cases().size(), 4u);
  EXPECT_EQ(fresh.cases().back().episode.features, labelled.episode.features);
  EXPECT_EQ(fresh.cases().back().what_was_done, "changed the brake relay");
  EXPECT_EQ(fresh.cases().back().features_by, "");
}

TEST(CarryOver, ACaseOfALabelledLogThatIsNotGivenAgainIsCarriedOver) {
  CaseBase old = base_of("old"), fresh = base_of("new");
  Case labelled = field_case(7.0);
  labelled.origin = kLabelledOrigin;
  labelled.what_was_done.clear();
  old.retain(labelled);
  CaseBase again = fresh;
  again.retain(labelled);
  EXPECT_EQ(carry_over(old, fresh).carried, 1);
  EXPECT_EQ(carry_over(old, again).carried, 0);
  EXPECT_EQ(again.cases().size(), 4u);
}

TEST(CarryOver, RepeatedCarryOverKeepsTheCasesAndTheirFirstModel) {
  CaseBase old = base_of("first");
  old.retain(field_case(2.0));
  for (const char* model : {"second", "third"}) {
    CaseBase fresh = base_of(model);
    carry_over(old, fresh);
    old = fresh;
  }
  ASSERT_EQ(old.cases().size(), 4u);
  EXPECT_EQ(old.cases().back().features_by, "first") << "they are still of that model";
}

}  // namespace
}  // namespace faultline
