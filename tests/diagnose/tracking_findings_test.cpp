// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/diagnose/relation_findings.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

const Chain& chain() {
  static const Robot robot = robot_from_toml("name = \"two\"\naxes = \"RP\"\n", "robot");
  return robot.chain;
}

/// Sums of a row of these ranges and root mean squares of target, prediction and reference.
RelationSums sums(double target, double predicted, double reference) {
  RelationSums out;
  out.low = out.predicted_low = out.reference_low = 0.0;
  out.high = target, out.predicted_high = predicted, out.reference_high = reference;
  out.target_square = target * target;
  out.predicted_square = predicted * predicted;
  out.reference_square = reference * reference;
  out.rows = 1;
  return out;
}

void set_share(RelationSums& of, double share, double explains) {
  of.product = -share * of.predicted_square;
  of.square = of.product * of.product / (of.predicted_square * explains);
}

RelationEpisode episode(Quantity target, Joint joint, double onset_s, double end_s) {
  RelationEpisode out;
  out.kind = RelationKind::tracking;
  out.target = target;
  out.joint = joint;
  out.onset_s = onset_s, out.alarm_s = onset_s + 0.1, out.end_s = end_s;
  out.mean = 0.2;
  out.at_first = sums(0.5, 0.6, 0.6);
  out.times_limit = 3.0;
  return out;
}

TEST(TrackingFindings, PositionAndVelocityOfOneJointAreOneFinding) {
  const auto faults = tracking_findings(
      {episode(Quantity::q, 1_joint, 4.0, 6.0), episode(Quantity::dq, 1_joint, 4.2, 7.0)}, chain());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].label, (FaultLabel{FaultKind::unknown, 1_joint}));
  EXPECT_EQ(faults[0].onset_s, 4.0);
  EXPECT_EQ(faults[0].end_s, 7.0);
}

TEST(TrackingFindings, TwoJointsAndLaterEpisodesAreSeparateFindings) {
  EXPECT_EQ(tracking_findings(
                {episode(Quantity::q, 1_joint, 4.0, 6.0), episode(Quantity::q, 2_joint, 4.0, 6.0)}, chain())
                .size(),
            2u);
  EXPECT_EQ(tracking_findings(
                {episode(Quantity::q, 1_joint, 4.0, 6.0), episode(Quantity::q, 1_joint, 8.0, 9.0)}, chain())
                .size(),
            2u);
}

TEST(TrackingFindings, AJointWhosePositionOrVelocityStandsStillIsLocked) {
  RelationEpisode still = episode(Quantity::dq, 1_joint, 4.2, 7.0);
  set_share(still.at_first, 0.95, 0.9);
  const auto faults = tracking_findings({episode(Quantity::q, 1_joint, 4.0, 6.0), still}, chain());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].label.kind, FaultKind::locked);
  EXPECT_EQ(faults[0].onset_s, 4.0);
  RelationEpisode frozen = episode(Quantity::q, 2_joint, 4.0, 6.0);
  frozen.at_first.high = 0.01;
  EXPECT_EQ(tracking_findings({frozen}, chain())[0].label.kind, FaultKind::locked);
}

TEST(TrackingFindings, AJointIsLockedOnlyIfItsReferenceMoves) {
  RelationEpisode frozen = episode(Quantity::q, 1_joint, 4.0, 6.0);
  frozen.at_first = sums(0.01, 0.6, 0.0);
  EXPECT_EQ(tracking_findings({frozen}, chain()).at(0).label.kind, FaultKind::unknown);
  RelationEpisode stopped = episode(Quantity::dq, 1_joint, 4.0, 6.0);
  stopped.at_first = sums(0.3, 0.6, 0.0);
  set_share(stopped.at_first, 0.95, 0.9);
  EXPECT_EQ(tracking_findings({stopped}, chain()).at(0).label.kind, FaultKind::unknown);
}

TEST(TrackingFindings, AJointAtRestWhoseReferenceIsAtRestHasNoFinding) {
  RelationEpisode rest = episode(Quantity::dq, 1_joint, 4.0, 6.0);
  rest.at_first = sums(0.001, 0.6, 0.0);
  set_share(rest.at_first, 1.0, 1.0);
  EXPECT_TRUE(tracking_findings({rest}, chain()).empty());
}

TEST(TrackingFindings, UnitsFollowFromTheTypeOfTheJoint) {
  const auto faults = tracking_findings(
      {episode(Quantity::q, 2_joint, 4.0, 6.0), episode(Quantity::dq, 2_joint, 8.0, 9.0)}, chain());
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].evidence[1].unit, "m");
  EXPECT_EQ(faults[1].evidence[1].unit, "m/s");
}

}  // namespace
}  // namespace faultline
