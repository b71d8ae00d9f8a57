// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lib/golden/comparison.hpp"

namespace faultline {
namespace {

ObservedEvent locked(double onset_s) {
  return {{{FaultKind::locked, 2}, onset_s, onset_s + 0.1, onset_s + 1.0, 0.9}};
}

Comparison compared(const std::vector<ObservedEvent>& expected, const std::vector<ObservedEvent>& actual,
                    const Tolerances& allowed = {}) {
  return compare_events(expected, actual, {&allowed});
}

TEST(CompareEvents, EventsOfOneLabelArePairedByTheNearestOnset) {
  const Comparison found = compared({locked(1.0), locked(5.0)}, {locked(5.0), locked(1.25), locked(9.0)});
  ASSERT_EQ(found.differences.size(), 4u);  // three times of the first pair, and one event too many
  EXPECT_EQ(found.differences[0].channel, "onset_s");
  EXPECT_EQ(found.differences[0].expected, "1");
  EXPECT_EQ(found.differences[0].actual, "1.25");
  EXPECT_EQ(found.differences[0].time_s, 1.0);
  EXPECT_EQ(found.differences[3].channel, "event");
  EXPECT_EQ(found.differences[3].time_s, 9.0);
  EXPECT_EQ(found.differences[3].expected, "");
}

TEST(CompareEvents, TimesAndConfidenceMayDifferWithinTheirTolerance) {
  Tolerances allowed;
  for (const char* time : {"onset_s", "alarm_s", "end_s"}) allowed.by_channel[time] = {0.3, 0.0};
  EXPECT_TRUE(compared({locked(1.0)}, {locked(1.25)}, allowed).same());
  ObservedEvent surer = locked(1.0);
  surer.confidence = 0.95;
  const Comparison found = compared({locked(1.0)}, {surer}, allowed);
  ASSERT_EQ(found.differences.size(), 1u);
  EXPECT_EQ(found.differences[0].channel, "confidence");
  EXPECT_EQ(found.differences[0].time_s, 1.0) << "a confidence belongs to the onset";
}

TEST(CompareEvents, AnotherKindOrJointIsOneMissingAndOneUnexpected) {
  ObservedEvent other = locked(1.0);
  other.label.kind = FaultKind::collision;
  const Comparison found = compared({locked(1.0)}, {other});
  ASSERT_EQ(found.differences.size(), 2u);
  EXPECT_EQ(found.differences[0].expected, "locked joint 2");
  EXPECT_EQ(found.differences[1].actual, "collision joint 2");
  ASSERT_EQ(found.lines.size(), 2u);
  EXPECT_EQ(found.lines[0].actual, "");
  EXPECT_EQ(found.lines[1].expected, "");
}

TEST(CompareEvents, AnUnknownTimeIsSaidAndAgreesWithItself) {
  ObservedEvent endless = locked(1.0);
  endless.end_s = NAN;
  endless.evidence = 120.0;
  endless.decided_by = "agreement";
  const Comparison same = compared({endless}, {endless});
  EXPECT_TRUE(same.same());
  EXPECT_EQ(
      same.lines.at(0).expected,
      "event locked joint 2: onset 1.000 s, alarm 1.100 s, end unknown, confidence 0.900, evidence 120, "
      "decided by agreement, MLP none 0.000, RBFN none 0.000, could also be nothing else");
  EXPECT_EQ(compared({endless}, {locked(1.0)}).differences.at(0).channel, "end_s");
}

TEST(CompareEvents, WhatAnEventRestsOnIsCompared) {
  ObservedEvent expected = locked(1.0);
  ObservedEvent actual = expected;
  actual.evidence = 100.0;
  expected = actual;
  actual.evidence = 40.0;
  actual.decided_by = "cases";
  actual.opinions.mlp.label = {FaultKind::locked, 3};
  actual.opinions.rbfn.confidence = 0.4;
  actual.could_also_be = {{FaultKind::friction_increase, 2}};
  const Comparison comparison = compared({expected}, {actual});
  std::vector<std::string> channels;
  for (const Difference& difference : comparison.differences) channels.push_back(difference.channel);
  EXPECT_EQ(channels,
            (std::vector<std::string>{"evidence", "decided_by", "mlp", "rbfn_confidence", "could_also_be"}));
  EXPECT_FALSE(comparison.changes_verdict());
}

}  // namespace
}  // namespace faultline
