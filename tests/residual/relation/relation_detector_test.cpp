// SPDX-License-Identifier: MIT
#include "lib/residual/relation/relation_detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/log/log_source.hpp"
#include "lib/residual/relation/learn_relations.hpp"
#include "tests/residual/relation/driven_joint.hpp"

namespace faultline {
namespace {

const std::vector<SignalRelation>& relations() {
  static const std::vector<SignalRelation> learned = [] {
    std::vector<MemorySource> days;
    for (const std::uint64_t seed : {1, 2, 3}) days.emplace_back(DrivenJoint{.seed = seed}.log(20.0));
    std::vector<LogSource*> pointers;
    for (MemorySource& day : days) pointers.push_back(&day);
    return learn_relations(pointers, {.period_s = 0.005});
  }();
  return learned;
}

std::vector<RelationEpisode> watched(RelationKind kind, const Log& log, int segment_rows = 4096) {
  for (const SignalRelation& relation : relations()) {
    if (relation.kind != kind) continue;
    RelationDetector watch(relation);
    MemorySource source(log, "log", segment_rows);
    for (Log segment; source.next(segment);) watch.take(segment);
    watch.finish();
    return watch.episodes();
  }
  throw std::runtime_error("no such relation");
}

TEST(RelationDetector, HealthyDaysRaiseNoAlarm) {
  for (std::uint64_t seed = 10; seed < 20; ++seed) {
    const Log log = DrivenJoint{.seed = seed}.log(30.0);
    EXPECT_TRUE(watched(RelationKind::actuator, log).empty()) << seed;
    EXPECT_TRUE(watched(RelationKind::control_law, log).empty()) << seed;
  }
}

TEST(RelationDetector, ATorqueWithoutACommandIsFoundWithItsTimeAndSize) {
  const Log log = DrivenJoint{.seed = 11, .in_drive = pulse(6.0, 6.3, 2.0)}.log(20.0);
  const auto episodes = watched(RelationKind::actuator, log);
  ASSERT_EQ(episodes.size(), 1u);
  EXPECT_NEAR(episodes[0].onset_s, 6.0, 0.03);
  EXPECT_LT(episodes[0].alarm_s, 6.1);
  EXPECT_NEAR(episodes[0].end_s, 6.3, 0.06);
  EXPECT_NEAR(episodes[0].mean, 2.0, 0.4);
  EXPECT_FALSE(episodes[0].lasts);
  EXPECT_TRUE(watched(RelationKind::control_law, log).empty()) << "the controller did what it always does";
}

TEST(RelationDetector, PulsesHalfASecondApartAreTwoEpisodes) {
  DrivenJoint joint{.seed = 12};
  joint.in_drive = [](double t) { return (t >= 6.0 && t < 6.2) || (t >= 6.7 && t < 6.9) ? -2.0 : 0.0; };
  EXPECT_EQ(watched(RelationKind::actuator, joint.log(20.0)).size(), 2u);
}

TEST(RelationDetector, PulsesOf300MillisecondsWith150BetweenThemAreSeparateEpisodes) {
  DrivenJoint joint{.seed = 12};
  joint.in_drive = [](double t) {
    const double of_period = std::fmod(t - 6.0, 0.45);
    return t >= 6.0 && t < 8.2 && of_period < 0.3 ? 2.0 : 0.0;
  };
  const auto episodes = watched(RelationKind::actuator, joint.log(20.0));
  ASSERT_EQ(episodes.size(), 5u);
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    EXPECT_NEAR(episodes[i].onset_s, 6.0 + 0.45 * static_cast<double>(i), 0.06) << i;
    EXPECT_NEAR(episodes[i].end_s, 6.3 + 0.45 * static_cast<double>(i), 0.13) << i;
  }
}

/// From 6 s on the drive stays at `limit` N m where the command exceeds it.
Log with_drive_limit(double limit, std::uint64_t seed) {
  Log log = DrivenJoint{.seed = seed}.log(20.0);
  for (double& torque : log.tau_meas[0]) torque = std::clamp(torque, -limit, limit);
  return log;
}

TEST(RelationDetector, ACommandBeyondTheLargestLearnedTorqueIsNotAFaultOfTheDrive) {
  constexpr double kLimit = 3.0;
  std::vector<MemorySource> days;
  for (const std::uint64_t seed : {1, 2, 3}) days.emplace_back(with_drive_limit(kLimit, seed));
  std::vector<LogSource*> pointers;
  for (MemorySource& day : days) pointers.push_back(&day);
  const std::vector<SignalRelation> learned = learn_relations(pointers, {.period_s = 0.005});
  ASSERT_FALSE(learned.empty());
  ASSERT_EQ(learned[0].kind, RelationKind::actuator);
  EXPECT_NEAR(learned[0].high, kLimit, 0.1);
  // The same drive at its limit for longer than ever in the healthy logs.
  Log log = with_drive_limit(kLimit, 11);
  for (int k = 1000; k < 1200; ++k) log.tau[0][k] = 3.4, log.tau_meas[0][k] = kLimit - 0.05;
  RelationDetector watch(learned[0]);
  watch.take(log);
  watch.finish();
  EXPECT_TRUE(watch.episodes().empty());
}

TEST(RelationDetector, ALostShareOfTheTorqueIsDistinguishedFromAnOffset) {
  const auto lost = watched(RelationKind::actuator,
                            DrivenJoint{.seed = 13, .drive_gain_from_s = 8.0, .drive_gain = 0.6}.log(20.0));
  ASSERT_FALSE(lost.empty());
  EXPECT_NEAR(lost[0].share, 0.4, 0.08);
  EXPECT_GT(lost[0].share_explains, 0.8);
  const auto offset =
      watched(RelationKind::actuator, DrivenJoint{.seed = 13, .in_drive = pulse(8.0, 99.0, 3.0)}.log(20.0));
  ASSERT_EQ(offset.size(), 1u);
  EXPECT_TRUE(offset[0].lasts);
  EXPECT_LT(offset[0].share_explains, 0.5);
}

TEST(RelationDetector, ATorqueAddedToTheCommandDeviatesFromTheLawButNotAtTheDrive) {
  const Log log = DrivenJoint{.seed = 14, .in_command = pulse(9.0, 9.2, 1.0)}.log(20.0);
  const auto law = watched(RelationKind::control_law, log);
  ASSERT_EQ(law.size(), 1u);
  EXPECT_NEAR(law[0].onset_s, 9.0, 0.02);
  EXPECT_NEAR(law[0].mean, 1.0, 0.2);
  EXPECT_TRUE(watched(RelationKind::actuator, log).empty());
}

TEST(RelationDetector, BordersOfSegmentsChangeNothing) {
  const Log log = DrivenJoint{.seed = 15, .in_drive = pulse(6.0, 6.3, 2.0)}.log(20.0);
  const auto whole = watched(RelationKind::actuator, log), pieces = watched(RelationKind::actuator, log, 7);
  ASSERT_EQ(whole.size(), pieces.size());
  EXPECT_EQ(whole[0].onset_s, pieces[0].onset_s);
  EXPECT_EQ(whole[0].end_s, pieces[0].end_s);
  EXPECT_EQ(whole[0].mean, pieces[0].mean);
}

TEST(RelationDetector, LostRowsAreNotAFault) {
  Log log = DrivenJoint{.seed = 16}.log(20.0);
  Log some = slice(log, 0, 1000);
  append(some, slice(log, 1020, 2000));
  append(some, slice(log, 2001, log.rows()));
  for (int k = 2500; k < 2520; ++k) some.tau_meas[0][k] = std::nan("");
  EXPECT_TRUE(watched(RelationKind::actuator, some).empty());
  EXPECT_TRUE(watched(RelationKind::control_law, some).empty());
}

TEST(RelationDetector, ALogWithoutTheSignalsIsNotJudged) {
  Log log = DrivenJoint{}.log(5.0);
  log.tau_meas.clear();
  RelationDetector watch(relations().front());
  watch.take(log);
  watch.finish();
  EXPECT_EQ(watch.judged_s(), 0.0);
}

}  // namespace
}  // namespace faultline
