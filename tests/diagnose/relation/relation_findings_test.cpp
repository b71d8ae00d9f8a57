// SPDX-License-Identifier: MIT
#include "lib/diagnose/relation/relation_findings.hpp"

#include <gtest/gtest.h>

#include "lib/diagnose/merge_faults.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

Chain chain() { return preset_robot("RR").chain; }

RelationEpisode episode(RelationKind kind, int joint, double onset_s, double end_s) {
  RelationEpisode out;
  out.kind = kind;
  out.joint = joint - 1;
  out.onset_s = onset_s;
  out.alarm_s = onset_s + 0.02;
  out.end_s = end_s;
  out.mean = 0.6;
  out.times_limit = 3.0;
  return out;
}

FaultFinding by_motion(FaultKind kind, int joint, double onset_s) {
  FaultFinding finding;
  finding.label = {kind, joint};
  finding.onset_s = onset_s;
  finding.alarm_s = onset_s + 0.1;
  finding.end_s = onset_s + 1.0;
  return finding;
}

TEST(RelationFindings, WhatTheMotionShowsOfTheSameThingIsEvidenceOfOneFinding) {
  const auto faults =
      with_relations({by_motion(FaultKind::collision, 2, 3.05), by_motion(FaultKind::locked, 2, 8.0)},
                     {episode(RelationKind::actuator, 1, 3.0, 3.2)}, chain());
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].label, (FaultLabel{FaultKind::locked, 2}));
  EXPECT_EQ(faults[1].label, (FaultLabel{FaultKind::unknown, 1}));
  EXPECT_EQ(faults[1].decided_by, DecidedBy::actuator);
  ASSERT_FALSE(faults[1].could_also_be.empty());
  EXPECT_EQ(faults[1].could_also_be[0].label, (FaultLabel{FaultKind::collision, 2}));
}

/// A finding that lasts to the end of the log, dated before an episode of the drive from 3 to 3.2 s.
std::size_t findings_with(double onset_s, double alarm_s) {
  FaultFinding early = by_motion(FaultKind::friction_increase, 2, onset_s);
  early.alarm_s = alarm_s;
  early.end_s = 20.0;
  return with_relations({early}, {episode(RelationKind::actuator, 1, 3.0, 3.2)}, chain()).size();
}

TEST(RelationFindings, AnOnsetDatedTooEarlyMakesNoSecondFindingWhereTheAlarmCameWithTheEpisode) {
  EXPECT_EQ(findings_with(2.69, 2.85), 1u);
  EXPECT_EQ(findings_with(2.69, 3.1), 1u);
  EXPECT_EQ(findings_with(2.69, 3.9), 1u);
  EXPECT_EQ(findings_with(2.3, 2.5), 2u) << "it alarmed before the drive strayed: another cause";
  EXPECT_EQ(findings_with(1.5, 3.1), 2u);
}

TEST(RelationFindings, ALossOfTorqueThatTheDriveSecondsKeepsItsName) {
  RelationEpisode less = episode(RelationKind::actuator, 1, 3.0, 9.0);
  less.share = 0.95;
  less.share_explains = 0.4;
  const auto faults = with_relations({by_motion(FaultKind::free_swinging, 1, 3.05)}, {less}, chain());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].label, (FaultLabel{FaultKind::free_swinging, 1}));
  less.share = -0.5;
  const auto added = with_relations({by_motion(FaultKind::torque_loss, 1, 3.05)}, {less}, chain());
  ASSERT_EQ(added.size(), 1u);
  EXPECT_EQ(added[0].label.kind, FaultKind::unknown) << "the drive gave more, not less";
}

TEST(RelationFindings, AnOffsetThatStaysMayBeThatOfTheSensor) {
  RelationEpisode offset = episode(RelationKind::actuator, 1, 3.0, 9.0);
  offset.offset_explains = 0.9;
  const FaultLabel sensor{FaultKind::torque_sensor_error, 1};
  const auto alone = with_relations({}, {offset}, chain());
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_EQ(alone[0].label, (FaultLabel{FaultKind::unknown, 1}));
  ASSERT_EQ(alone[0].could_also_be.size(), 1u);
  EXPECT_EQ(alone[0].could_also_be[0].label, sensor);
  const auto both = with_relations({by_motion(sensor.kind, 1, 3.05)}, {offset}, chain());
  ASSERT_EQ(both.size(), 1u);
  EXPECT_EQ(both[0].label, sensor);
  offset.end_s = 3.2;
  EXPECT_TRUE(with_relations({}, {offset}, chain())[0].could_also_be.empty());
}

TEST(RelationFindings, AShareOfTheCommandThatIsMissingIsALossOfTorque) {
  RelationEpisode lost = episode(RelationKind::actuator, 1, 3.0, 9.0);
  lost.share = 0.4;
  lost.share_explains = 0.9;
  EXPECT_EQ(finding_of(lost, chain()).label, (FaultLabel{FaultKind::torque_loss, 1}));
  lost.share_explains = 0.2;
  EXPECT_EQ(finding_of(lost, chain()).label, (FaultLabel{FaultKind::unknown, 1}));
}

TEST(RelationFindings, ALawThatIsLeftForLongAfterAFaultFollowsFromIt) {
  const auto faults = with_relations({by_motion(FaultKind::locked, 1, 3.0)},
                                     {episode(RelationKind::control_law, 1, 4.0, 9.0)}, chain());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].label.kind, FaultKind::locked);
}

TEST(RelationFindings, AJoltOfAnotherDriveMeanwhileFollowsFromIt) {
  const auto faults = with_relations(
      {}, {episode(RelationKind::actuator, 1, 4.0, 4.5), episode(RelationKind::actuator, 2, 4.45, 4.5)},
      chain());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].label.joint, 1);
}

TEST(RelationFindings, TwoDrivesThatStrayAtTheSameTimeAreTwoFindings) {
  EXPECT_EQ(
      with_relations(
          {}, {episode(RelationKind::actuator, 1, 4.0, 4.5), episode(RelationKind::actuator, 2, 4.1, 4.6)},
          chain())
          .size(),
      2u);
}

TEST(RelationFindings, ALawThatIsLeftWithNothingBeforeItIsAFinding) {
  const auto faults = with_relations({}, {episode(RelationKind::control_law, 2, 4.0, 9.0)}, chain());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].decided_by, DecidedBy::control_law);
  EXPECT_EQ(faults[0].label, (FaultLabel{FaultKind::unknown, 2}));
}

TEST(RelationFindings, PulsesInQuickSuccessionStaySingle) {
  auto faults = with_relations(
      {}, {episode(RelationKind::actuator, 1, 3.0, 3.2), episode(RelationKind::actuator, 1, 3.6, 3.8)},
      chain());
  EXPECT_EQ(merge_continued(std::move(faults)).size(), 2u);
}

}  // namespace
}  // namespace faultline
