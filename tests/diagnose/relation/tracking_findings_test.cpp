// SPDX-License-Identifier: MIT
#include "lib/diagnose/relation/tracking_findings.hpp"

#include <gtest/gtest.h>

#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

const Chain& chain() {
  static const Robot robot = robot_from_toml("name = \"two\"\naxes = \"RP\"\n", "robot");
  return robot.chain;
}

RelationEpisode episode(Quantity target, int joint, double onset_s, double end_s) {
  RelationEpisode out;
  out.kind = RelationKind::tracking;
  out.target = target;
  out.joint = joint - 1;
  out.onset_s = onset_s, out.alarm_s = onset_s + 0.1, out.end_s = end_s;
  out.mean = 0.2;
  out.first_span = 0.5, out.first_predicted_span = 0.6, out.first_reference_span = 0.6;
  out.first_rms = 0.5, out.first_predicted_rms = 0.6, out.first_reference_rms = 0.6;
  out.times_limit = 3.0;
  return out;
}

TEST(TrackingFindings, PositionAndVelocityOfOneJointAreOneFinding) {
  const auto faults =
      tracking_findings({episode(Quantity::q, 1, 4.0, 6.0), episode(Quantity::dq, 1, 4.2, 7.0)}, chain());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].label, (FaultLabel{FaultKind::unknown, 1}));
  EXPECT_EQ(faults[0].onset_s, 4.0);
  EXPECT_EQ(faults[0].end_s, 7.0);
}

TEST(TrackingFindings, TwoJointsAreTwoAndLaterOnesStandAlone) {
  EXPECT_EQ(tracking_findings({episode(Quantity::q, 1, 4.0, 6.0), episode(Quantity::q, 2, 4.0, 6.0)}, chain())
                .size(),
            2u);
  EXPECT_EQ(tracking_findings({episode(Quantity::q, 1, 4.0, 6.0), episode(Quantity::q, 1, 8.0, 9.0)}, chain())
                .size(),
            2u);
}

TEST(TrackingFindings, AJointThatStandsStillIsLockedWhicheverSignalSaysSo) {
  RelationEpisode still = episode(Quantity::dq, 1, 4.2, 7.0);
  still.first_share = 0.95, still.first_share_explains = 0.9;
  const auto faults = tracking_findings({episode(Quantity::q, 1, 4.0, 6.0), still}, chain());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].label.kind, FaultKind::locked);
  EXPECT_EQ(faults[0].onset_s, 4.0);
  RelationEpisode frozen = episode(Quantity::q, 2, 4.0, 6.0);
  frozen.first_span = 0.01;
  EXPECT_EQ(tracking_findings({frozen}, chain())[0].label.kind, FaultKind::locked);
}

TEST(TrackingFindings, AJointStandsStillOnlyWhileItsReferenceMoves) {
  RelationEpisode frozen = episode(Quantity::q, 1, 4.0, 6.0);
  frozen.first_span = 0.01, frozen.first_reference_span = 0.0;
  EXPECT_EQ(tracking_findings({frozen}, chain()).at(0).label.kind, FaultKind::unknown);
  RelationEpisode stopped = episode(Quantity::dq, 1, 4.0, 6.0);
  stopped.first_share = 0.95, stopped.first_share_explains = 0.9, stopped.first_rms = 0.3;
  stopped.first_reference_rms = 0.0;
  EXPECT_EQ(tracking_findings({stopped}, chain()).at(0).label.kind, FaultKind::unknown);
}

TEST(TrackingFindings, AJointAtRestWhoseReferenceIsAtRestIsNone) {
  RelationEpisode rest = episode(Quantity::dq, 1, 4.0, 6.0);
  rest.first_share = 1.0, rest.first_share_explains = 1.0, rest.first_rms = 0.001;
  rest.first_reference_rms = 0.0;
  EXPECT_TRUE(tracking_findings({rest}, chain()).empty());
}

TEST(TrackingFindings, UnitsAreThoseOfTheJoint) {
  const auto faults =
      tracking_findings({episode(Quantity::q, 2, 4.0, 6.0), episode(Quantity::dq, 2, 8.0, 9.0)}, chain());
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].evidence[1].unit, "m");
  EXPECT_EQ(faults[1].evidence[1].unit, "m/s");
}

}  // namespace
}  // namespace faultline
