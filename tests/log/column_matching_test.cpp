// SPDX-License-Identifier: MIT
#include "lib/log/column_matching.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "lib/core/error.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

using Names = std::map<std::string, std::string>;

/// Channel name to column name.
Names matched(const std::vector<std::string>& names, const ColumnMap& map = {}) {
  std::vector<RawColumn> columns;
  for (const std::string& name : names) columns.push_back({name, ""});
  Names result;
  for (const ChannelSource& source : match_columns(columns, map, "log").channels)
    result[to_string(source.channel)] = source.column >= 0 ? names[source.column] : "";
  return result;
}

TEST(ColumnMatching, ASecondTorqueIsTheCommandedOrTheMeasuredOne) {
  EXPECT_EQ(matched({"time", "pos_meas1", "tau_con1", "tau_meas1"}),
            (Names{{"t", "time"}, {"q1", "pos_meas1"}, {"tau1", "tau_con1"}, {"tau_meas1", "tau_meas1"}}));
  EXPECT_EQ(matched({"t", "q1", "target_torque_1", "actual_torque_1"}),
            (Names{{"t", "t"}, {"q1", "q1"}, {"tau1", "target_torque_1"}, {"tau_meas1", "actual_torque_1"}}))
      << "what tau's own name says is not there a second time";
  EXPECT_EQ(
      matched({"t", "q1", "tau1", "tau_ref1", "tau_meas1"}),
      (Names{
          {"t", "t"}, {"q1", "q1"}, {"tau1", "tau1"}, {"tau_ref1", "tau_ref1"}, {"tau_meas1", "tau_meas1"}}));
  EXPECT_EQ(matched({"t", "q1", "tau_meas1"}), (Names{{"t", "t"}, {"q1", "q1"}, {"tau1", "tau_meas1"}}))
      << "the only torque is the torque";
}

TEST(ColumnMatching, NamesThatCountFromZeroAreMatched) {
  EXPECT_EQ(matched({"timestamp", "target_q_0", "target_q_1", "actual_q_0", "actual_q_1", "actual_qd_0",
                     "actual_qd_1", "target_moment_0", "target_moment_1", "actual_TCP_pose_0"}),
            (Names{{"t", "timestamp"},
                   {"q1", "actual_q_0"},
                   {"q2", "actual_q_1"},
                   {"dq1", "actual_qd_0"},
                   {"dq2", "actual_qd_1"},
                   {"tau1", "target_moment_0"},
                   {"tau2", "target_moment_1"},
                   {"q_ref1", "target_q_0"},
                   {"q_ref2", "target_q_1"}}));
}

TEST(ColumnMatching, NamesOfJointStatesAreMatched) {
  EXPECT_EQ(matched({"__time", "/joint_states/position[0]", "/joint_states/position[1]",
                     "/joint_states/velocity[0]", "/joint_states/velocity[1]", "/joint_states/effort[0]",
                     "/joint_states/effort[1]", "/joint_states/header/stamp/nanosec"}),
            (Names{{"t", "__time"},
                   {"q1", "/joint_states/position[0]"},
                   {"q2", "/joint_states/position[1]"},
                   {"dq1", "/joint_states/velocity[0]"},
                   {"dq2", "/joint_states/velocity[1]"},
                   {"tau1", "/joint_states/effort[0]"},
                   {"tau2", "/joint_states/effort[1]"}}));
}

TEST(ColumnMatching, PlainWordsThatCountFromOneAreMatched) {
  EXPECT_EQ(matched({"time", "position_1", "position_2", "speed_1", "speed_2", "torque_1", "torque_2"}),
            (Names{{"t", "time"},
                   {"q1", "position_1"},
                   {"q2", "position_2"},
                   {"dq1", "speed_1"},
                   {"dq2", "speed_2"},
                   {"tau1", "torque_1"},
                   {"tau2", "torque_2"}}));
}

TEST(ColumnMatching, OneAxisNeedsNoNumbers) {
  EXPECT_EQ(matched({"t", "qm", "qg", "force"}),
            (Names{{"t", "t"}, {"q1", "qm"}, {"q_ref1", "qg"}, {"tau1", "force"}}));
}

TEST(ColumnMatching, ErrorsLimitsAndAccelerationsAreNotPositions) {
  EXPECT_EQ(matched({"t", "q1", "q_error1", "position_limit_1", "qdd1"}), (Names{{"t", "t"}, {"q1", "q1"}}));
}

TEST(ColumnMatching, SecondsAndNanosecondsMakeATime) {
  const std::vector<RawColumn> columns{{"header/stamp/nanosec", ""}, {"header/stamp/sec", ""}, {"q1", ""}};
  const Matching matching = match_columns(columns, {}, "log");
  EXPECT_EQ(matching.channels[0].column, 1);
  EXPECT_EQ(matching.channels[0].nanoseconds_column, 0);
}

TEST(ColumnMatching, TheColumnMapOverridesNames) {
  EXPECT_EQ(matched({"t", "q1", "arm"}, {{"q1", {.name = "arm"}}}), (Names{{"t", "t"}, {"q1", "arm"}}));
}

TEST(ColumnMatching, AMissingColumnOfAJointIsReported) {
  const std::vector<RawColumn> columns{{"t", ""}, {"q1", ""}, {"q2", ""}, {"tau1", ""}};
  EXPECT_NE(match_columns(columns, {}, "log").issues.find("channel_missing", "tau2"), nullptr);
}

TEST(ColumnMatching, AMissingColumnOfAJointHidesNoOtherJoint) {
  EXPECT_EQ(
      matched({"t", "q1", "q2", "q3", "tau1", "tau3"}),
      (Names{{"t", "t"}, {"q1", "q1"}, {"q2", "q2"}, {"q3", "q3"}, {"tau1", "tau1"}, {"tau3", "tau3"}}));
  EXPECT_EQ(matched({"t", "q1", "q2", "dq2"}),
            (Names{{"t", "t"}, {"q1", "q1"}, {"q2", "q2"}, {"dq2", "dq2"}}));
  EXPECT_EQ(matched({"time", "pos_0", "pos_1", "pos_2", "vel_1", "vel_2"}), (Names{{"t", "time"},
                                                                                   {"q1", "pos_0"},
                                                                                   {"q2", "pos_1"},
                                                                                   {"q3", "pos_2"},
                                                                                   {"dq2", "vel_1"},
                                                                                   {"dq3", "vel_2"}}))
      << "numbers from 0 mean the same joints in every quantity";
  EXPECT_EQ(matched({"time", "pos_0", "pos_1", "vel_1", "vel_2"}),
            (Names{{"t", "time"}, {"q1", "pos_0"}, {"q2", "pos_1"}, {"dq1", "vel_1"}, {"dq2", "vel_2"}}))
      << "unless they do not fit";
}

TEST(ColumnMatching, VelocitiesThatSomeJointLacksAreLeftOutWithAnIssue) {
  const std::vector<RawColumn> partial{{"t", ""}, {"q1", ""}, {"q2", ""}, {"dq2", ""}},
      whole{{"t", ""}, {"q1", ""}, {"dq1", ""}};
  const Matching left = without_partial_velocity(match_columns(partial, {}, "log"));
  EXPECT_EQ(left.channels.size(), 3u);
  ASSERT_NE(left.issues.find("velocities_left_out"), nullptr);
  EXPECT_NE(left.issues.find("velocities_left_out")->message.find("no column for dq1"), std::string::npos);
  const Matching kept = without_partial_velocity(match_columns(whole, {}, "log"));
  EXPECT_EQ(kept.channels.size(), 3u);
  EXPECT_EQ(kept.issues.find("velocities_left_out"), nullptr);
}

TEST(ColumnMatching, AMissingPositionBetweenOthersIsReported) {
  const std::vector<RawColumn> columns{{"t", ""}, {"q1", ""}, {"q3", ""}};
  const Matching matching = match_columns(columns, {}, "log");
  EXPECT_EQ(matching.joints, 1);
  ASSERT_NE(matching.issues.find("channel_missing", "q2"), nullptr);
  EXPECT_EQ(matching.issues.find("channel_missing", "q2")->severity, Severity::severe);
}

TEST(ColumnMatching, CartesianAndGripperColumnsAreNotJoints) {
  EXPECT_EQ(
      matched({"time", "CartPos_X", "CartPos_Y", "CartPos_Z", "JointPos_1", "JointPos_2", "GripperForce_%"}),
      (Names{{"t", "time"}, {"q1", "JointPos_1"}, {"q2", "JointPos_2"}}));
  EXPECT_THROW(matched({"time", "CartPos_X", "CartPos_Y"}), Error);
}

/// The matching of t, q1 and one more column.
Matching matching_with(const RawColumn& column, const ColumnMap& map = {}) {
  return match_columns({{"t", ""}, {"q1", ""}, column}, map, "log");
}

TEST(ColumnMatching, ACurrentIsNotATorqueWithoutAScale) {
  for (const RawColumn& column :
       {RawColumn{"tau1", "A"}, {"effort_1", "mA"}, {"torque_1", "%"}, {"tau1", "V"}}) {
    try {
      matching_with(column);
      FAIL() << column.name;
    } catch (const Error& error) {
      for (const char* word : {"tau1", "scale", "N m"})
        EXPECT_NE(error.message().find(word), std::string::npos) << error.message();
      EXPECT_NE(error.message().find(column.name), std::string::npos);
    }
  }
  const Matching scaled = matching_with({"tau1", "mA"}, {{"tau1", {.scale = 35.0}}});
  EXPECT_DOUBLE_EQ(scaled.channels.back().gain, 0.035);
  EXPECT_DOUBLE_EQ(matching_with({"i1", "A"}, {{"tau1", {.name = "i1", .scale = 35.0}}}).channels.back().gain,
                   35.0);
  EXPECT_DOUBLE_EQ(matching_with({"tau1", "A"}, {{"tau1", {.unit = "N m"}}}).channels.back().gain, 1.0);
  EXPECT_THROW(matching_with({"i1", ""}, {{"tau1", {.name = "i1", .unit = "A"}}}), Error);
}

TEST(ColumnMatching, AColumnInAnotherDimensionIsNotMatched) {
  const Matching speed = matching_with({"Speed", "%"});
  EXPECT_EQ(speed.channels.size(), 2u);
  EXPECT_NE(speed.issues.find("unit_of_other_dimension", "dq1"), nullptr);
  const Matching both =
      match_columns({{"t", ""}, {"q1", ""}, {"target_torque_1", "N m"}, {"actual_torque_1", "A"}}, {}, "log");
  EXPECT_EQ(both.channels.size(), 3u);
  EXPECT_THROW(match_columns({{"t", "deg"}, {"q1", ""}}, {}, "log"), Error);
  EXPECT_THROW(match_columns({{"t", ""}, {"q1", "V"}}, {}, "log"), Error);
}

TEST(ColumnMatching, SeveralCandidateColumnsAreReported) {
  const std::vector<RawColumn> columns{{"t", ""}, {"q1", ""}, {"tau_con1", ""}, {"tau_ctrl1", ""}};
  const Matching matching = match_columns(columns, {}, "log");
  ASSERT_NE(matching.issues.find("channel_ambiguous", "tau1"), nullptr);
  EXPECT_NE(matching.issues.find("channel_ambiguous", "tau1")->message.find("tau_ctrl1"), std::string::npos);
}

TEST(ColumnMatching, AChannelThatDoesNotExistIsAUsageError) {
  try {
    matched({"t", "q1"}, {{"speed1", {.name = "q1"}}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(error.message().find("dq1"), std::string::npos);
  }
}

TEST(Units, KnownUnitsHaveFactorsAndUnknownUnitsHaveNone) {
  EXPECT_DOUBLE_EQ(si_factor("deg").value(), std::numbers::pi / 180.0);
  EXPECT_DOUBLE_EQ(si_factor("rpm").value(), std::numbers::pi / 30.0);
  EXPECT_DOUBLE_EQ(si_factor("Grad").value(), std::numbers::pi / 180.0) << "German for degree";
  EXPECT_DOUBLE_EQ(si_factor("Grad/s").value(), std::numbers::pi / 180.0);
  EXPECT_DOUBLE_EQ(si_factor("U/min").value(), std::numbers::pi / 30.0);
  EXPECT_EQ(known_unit("A")->dimension, Dimension::current);
  EXPECT_EQ(si_factor("N m"), 1.0);
  EXPECT_EQ(si_factor("ms"), 1e-3);
  EXPECT_EQ(si_factor(""), 1.0);
  EXPECT_FALSE(si_factor("furlong"));
}

TEST(Units, AreSplitFromTheNameOfAColumn) {
  auto split = [](const char* text) {
    const NameAndUnit parts = split_unit(text);
    return parts.name + "|" + parts.unit;
  };
  EXPECT_EQ(split("q1 [deg]"), "q1|deg");
  EXPECT_EQ(split("Program Time (s)"), "Program Time|s");
  EXPECT_EQ(split("time_ms"), "time|ms");
  EXPECT_EQ(split("positions[0]"), "positions[0]|");
  EXPECT_EQ(split("abs(error)"), "abs(error)|");
  EXPECT_EQ(split("vel_m"), "vel_m|");
}

TEST(ColumnMatching, JointsNamedByWordsAreJointsInTheirOrder) {
  const std::vector<RawColumn> columns{{"t", ""},
                                       {"shoulder_pos", ""},
                                       {"elbow_pos", ""},
                                       {"elbow_torque", ""},
                                       {"shoulder_torque", ""},
                                       {"elbow_vel", ""}};
  const Matching matching = match_columns(columns, {}, "log");
  EXPECT_EQ(matching.joints, 2);
  const auto column_of = [&](Channel channel) {
    for (const ChannelSource& source : matching.channels)
      if (source.channel == channel) return source.column;
    return -1;
  };
  EXPECT_EQ(column_of({Quantity::q, 2_joint}), 2);
  EXPECT_EQ(column_of({Quantity::tau, 1_joint}), 4);
  EXPECT_EQ(column_of({Quantity::tau, 2_joint}), 3);
  EXPECT_EQ(column_of({Quantity::dq, 1_joint}), -1);
  EXPECT_EQ(column_of({Quantity::dq, 2_joint}), 5);
  EXPECT_NE(matching.issues.find("joint_order"), nullptr);
}

TEST(ColumnMatching, JointsOfAMergedRecordingKeepTheirSignalsTogether) {
  std::vector<RawColumn> columns{{"__time", ""}};
  for (const char* joint : {"shoulder_pan_joint", "shoulder_lift_joint", "wrist_1_joint", "wrist_2_joint"})
    for (const char* array : {"effort", "position", "velocity"})
      columns.push_back({std::string("/joint_states/") + joint + "/" + array, ""});
  const Matching matching = match_columns(columns, {}, "log");
  EXPECT_EQ(matching.joints, 4);
  for (const ChannelSource& source : matching.channels) {
    if (source.channel.joint.is_none()) continue;
    EXPECT_EQ((source.column - 1) / 3, source.channel.joint.index());
  }
}

TEST(ColumnMatching, TwoWaysToMeasureOneJointAreOneJoint) {
  for (const char* other : {"raw_pos", "motor_pos", "pos_filtered", "encoder_pos"})
    EXPECT_EQ(match_columns({{"t", ""}, {"pos", ""}, {other, ""}, {"link_pos", ""}}, {}, "log").joints, 1)
        << other;
}

}  // namespace
}  // namespace faultline
