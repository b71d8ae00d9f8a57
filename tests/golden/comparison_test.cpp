// SPDX-License-Identifier: MIT
#include "lib/golden/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Observation example() {
  Observation o;
  o.verdict = "faulty";
  o.rows = 4;
  o.events = {{{{FaultKind::locked, 2_joint}, 1.0, 1.1, 2.0, 0.9}},
              {{{FaultKind::collision, 1_joint}, 3.0, 3.1, 3.2, 0.8}}};
  o.residuals = {{1_joint, 1.0, 4.0, 1.5, 1.2}, {2_joint, kNan, kNan, kNan, kNan}};
  o.trace = {{"q1", "dq1"}, {0.1, 0.2, 0.3}, {{1.0, 2.0, kNan}, {0.5, 0.5, 0.5}}};
  return o;
}

ToleranceChain none() { return {}; }

TEST(GoldenComparison, EqualObservationsAreTheSameAlsoIfTheyHoldNan) {
  EXPECT_TRUE(compare(example(), example(), none()).same());
  EXPECT_EQ(first_divergence(compare(example(), example(), none())), nullptr);
}

TEST(GoldenComparison, NanInPlaceOfANumberIsADifferenceAnywhere) {
  for (int place = 0; place < 4; ++place) {
    Observation actual = example();
    if (place == 0) actual.residuals[0].velocity_rms = kNan;
    if (place == 1) actual.residuals[1].position_rms = 1.0;
    if (place == 2) actual.trace.values[0][2] = 1.0;
    if (place == 3) actual.events[0].end_s = kNan;
    const Comparison found = compare(example(), actual, none());
    EXPECT_EQ(found.differences.size(), 1u) << place;
  }
}

TEST(GoldenComparison, AnotherNumberOfRowsIsADifferenceUnlessAllowed) {
  Observation longer = example();
  longer.rows = 5;
  longer.trace.time.insert(longer.trace.time.begin(), 0.05);
  for (auto& values : longer.trace.values) values.insert(values.begin(), 9.0);
  Comparison found = compare(example(), longer, none());
  ASSERT_EQ(found.differences.size(), 2u);
  EXPECT_EQ(found.differences[0].channel, "rows");
  EXPECT_EQ(found.differences[1].channel, "t");
  EXPECT_EQ(found.differences[1].time_s, 0.05);
  EXPECT_EQ(found.differences[1].actual, "a sample at 0.05 s");
  Tolerances allow;
  allow.length_may_differ = true;
  EXPECT_TRUE(compare(example(), longer, {&allow}).same());
  longer.trace.values[1][3] = 0.7;  // still compared where both have a time
  found = compare(example(), longer, {&allow});
  ASSERT_EQ(found.differences.size(), 1u);
  EXPECT_EQ(found.differences[0].channel, "dq1");
  EXPECT_EQ(found.differences[0].time_s, 0.3);
}

TEST(GoldenComparison, TheSameRowsAtOtherTimesAreADifference) {
  Observation shifted = example();
  for (double& t : shifted.trace.time) t += 0.01;
  const Comparison found = compare(example(), shifted, none());
  ASSERT_EQ(found.differences.size(), 1u);
  EXPECT_EQ(found.differences[0].expected, "a sample at 0.1 s");
}

TEST(GoldenComparison, EventsAreTheSameInAnyOrder) {
  Observation swapped = example();
  std::swap(swapped.events[0], swapped.events[1]);
  EXPECT_TRUE(compare(example(), swapped, none()).same());
}

TEST(GoldenComparison, TheFirstDivergenceIsTheEarliest) {
  Observation actual = example();
  actual.events[1].onset_s = 2.9;
  actual.trace.values[1][1] = 0.6;
  const Comparison found = compare(example(), actual, none());
  const Difference* first = first_divergence(found);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->channel, "dq1");
  EXPECT_EQ(first->time_s, 0.2);
  EXPECT_EQ(first->actual, "0.6");
  EXPECT_EQ(first->expected, "0.5");
}

TEST(GoldenComparison, MissingAndUnexpectedEventsAndAChangedTimeAreDifferences) {
  Observation actual = example();
  actual.events[0].label.joint = 3_joint;
  actual.events[1].alarm_s = 3.15;
  const Comparison found = compare(example(), actual, none());
  ASSERT_EQ(found.differences.size(), 3u);
  EXPECT_EQ(found.differences[0].expected, "locked joint 2");
  EXPECT_EQ(found.differences[1].channel, "alarm_s");
  EXPECT_EQ(found.differences[2].actual, "locked joint 3");
}

TEST(GoldenComparison, AVerdictHasNoTimeAndNoTolerance) {
  Observation actual = example();
  actual.verdict = "healthy";
  actual.events.pop_back();
  const Comparison found = compare(example(), actual, none());
  ASSERT_EQ(found.differences.size(), 2u);
  EXPECT_TRUE(std::isnan(found.differences[0].time_s));
  EXPECT_TRUE(std::isnan(found.differences[0].allowed));
  EXPECT_TRUE(std::isnan(found.differences[1].allowed));
  EXPECT_EQ(first_divergence(found)->time_s, 3.0);
}

TEST(GoldenComparison, ALogThatCannotBeProcessedAnyMoreDiffersAndNamesTheReason) {
  Observation unusable;
  unusable.verdict = kUnusable;
  unusable.reason = "has no time";
  const Comparison found = compare(example(), unusable, none());
  ASSERT_EQ(found.differences.size(), 1u);
  EXPECT_NE(found.lines.back().actual.find("has no time"), std::string::npos);
}

TEST(GoldenComparison, ParametersAreComparedByName) {
  const ObservedIdentification expected{
      "converged", "weak_form", {{"m1", 1.0, 0.1, "kg"}, {"l2", 2.0, kNan, "m"}}, ""};
  ObservedIdentification actual = expected;
  std::swap(actual.parameters[0], actual.parameters[1]);
  EXPECT_TRUE(compare(expected, actual, none()).same());
  actual.parameters[1].value = 1.01;
  EXPECT_EQ(first_divergence(compare(expected, actual, none()))->channel, "m1");
  Tolerances allow;
  allow.by_channel["parameter"] = {0.0, 0.02};
  EXPECT_TRUE(compare(expected, actual, {&allow}).same());
  actual.parameters.pop_back();
  EXPECT_FALSE(compare(expected, actual, {&allow}).same());
}

TEST(CompareGolden, AnotherEventChangesTheVerdictButOtherTimesDoNot) {
  Observation later = example();
  later.events[0].onset_s = 1.2;
  EXPECT_FALSE(compare(example(), later, none()).same());
  EXPECT_FALSE(compare(example(), later, none()).changes_verdict());
  later.events.pop_back();
  EXPECT_TRUE(compare(example(), later, none()).changes_verdict());
}

TEST(CompareGolden, ValuesOfAModelAreComparedByNameAndFamily) {
  const std::vector<ParameterValue> expected = {{"model_a", 1.0, 0.01, "kg m^2"},
                                                {"threshold", 18.0, kNan, "nats"}};
  std::vector<ParameterValue> actual = expected;
  Tolerances allowed;
  allowed.by_channel["model"] = {0.0, 0.002};
  actual[0].value = 1.001;
  EXPECT_TRUE(compare(expected, actual, {&allowed}).same());
  actual[0].value = 1.005;
  actual[1].value = 30.0;
  actual.push_back({"threshold_locked_2", 40.0, kNan, "nats"});
  const Comparison comparison = compare(expected, actual, {&allowed});
  ASSERT_EQ(comparison.differences.size(), 3u);
  EXPECT_EQ(comparison.differences[0].channel, "model_a");
  EXPECT_EQ(comparison.differences[1].channel, "threshold");
  EXPECT_EQ(comparison.differences[2].channel, "threshold_locked_2");
}

ObservedEvent locked(double onset_s) {
  return {{{FaultKind::locked, 2_joint}, onset_s, onset_s + 0.1, onset_s + 1.0, 0.9}};
}

Comparison compared(const std::vector<ObservedEvent>& expected, const std::vector<ObservedEvent>& actual,
                    const Tolerances& allowed = {}) {
  Comparison comparison;
  compare_events(expected, actual, {&allowed}, comparison);
  return comparison;
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

TEST(CompareEvents, AnUnknownTimeIsNamedAndEqualsItself) {
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

TEST(CompareEvents, EvidenceDecisionAndOpinionsOfAnEventAreCompared) {
  ObservedEvent expected = locked(1.0);
  ObservedEvent actual = expected;
  actual.evidence = 100.0;
  expected = actual;
  actual.evidence = 40.0;
  actual.decided_by = "cases";
  actual.opinions.mlp.label = {FaultKind::locked, 3_joint};
  actual.opinions.rbfn.confidence = 0.4;
  actual.could_also_be = {{FaultKind::friction_increase, 2_joint}};
  const Comparison comparison = compared({expected}, {actual});
  std::vector<std::string> channels;
  for (const Difference& difference : comparison.differences) channels.push_back(difference.channel);
  EXPECT_EQ(channels,
            (std::vector<std::string>{"evidence", "decided_by", "mlp", "rbfn_confidence", "could_also_be"}));
  EXPECT_FALSE(comparison.changes_verdict());
}

}  // namespace
}  // namespace faultline
