// SPDX-License-Identifier: MIT
// Merging bases, and what counts as the same event.
#include <gtest/gtest.h>

#include <limits>

#include "lib/cases/case_base.hpp"
#include "lib/core/error.hpp"
#include "tests/cases/example_base.hpp"

namespace faultline {
namespace {

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

TEST(SameEvent, IsTheSameLogOnsetAndName) {
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
  EXPECT_FALSE(is_same_event(unknown, unknown)) << "nothing tells that they are one";
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

TEST(MergeCases, AJointThatTheRobotHasNotIsRefused) {
  CaseBase base = base_of("bench", "RRP"), other = base_of("bench 7", "RRP");
  other.reject(1, FaultLabel{FaultKind::locked, 7});
  EXPECT_THROW(base.merge(other), Error);
}

TEST(MergeCases, TwiceAddsNothing) {
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

TEST(MergeCases, ThereAndBackAddsNothing) {
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

TEST(MergeCases, WhatSomebodySaidSinceIsTaken) {
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
