// SPDX-License-Identifier: MIT
#include "formats/messages/joint_views.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace faultline {
namespace {

/// The views of a message that is written as JSON.
std::vector<JointView> views_of_json(const std::string& type, const std::string& json) {
  MessageContent content;
  const auto decoder = content_decoder({"/topic", type, "json"});
  EXPECT_TRUE(decoder->decode(json, content)) << json;
  return joint_views(type, content);
}

TEST(JointViews, AFrankaArmHasTheMeasuredTorqueAndTheDesiredMotionWithoutTorque) {
  const std::string json =
      R"({"q": [1, 2], "dq": [3, 4], "tau_J": [5, 6], "q_d": [7, 8], "dq_d": [9, 10], "tau_J_d": [11, 12]})";
  const auto views = views_of_json("franka_msgs/FrankaState", json);
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(views[0].role, TopicRole::reference);
  EXPECT_EQ(views[0].row, (JointRow{{{7.0, 8.0}, {9.0, 10.0}, {}}}));
  EXPECT_EQ(views[1].role, TopicRole::measured);
  EXPECT_EQ(views[1].row, (JointRow{{{1.0, 2.0}, {3.0, 4.0}, {5.0, 6.0}}}));
  EXPECT_TRUE(views[1].joints.empty()) << "the message has no names";
}

TEST(JointViews, TheFrankaStateOfRos2WithoutUpperCaseIsReadToo) {
  const auto views = views_of_json("franka_msgs/msg/FrankaState", R"({"q": [1], "dq": [2], "tau_j": [3]})");
  ASSERT_EQ(views.size(), 1U);
  EXPECT_EQ(views[0].row[2], std::vector<double>{3.0});
}

TEST(JointViews, AFrankaRobotStateHasTheNamesOfItsJoints) {
  const auto views = views_of_json(
      "franka_msgs/msg/FrankaRobotState",
      R"({"measured_joint_state": {"name": ["a", "b"], "position": [1, 2], "velocity": [3, 4], "effort": [5, 6]},
          "desired_joint_state": {"name": ["a", "b"], "position": [7, 8], "velocity": [9, 10], "effort": [0, 0]}})");
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(views[1].joints, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(views[1].row[2], (std::vector<double>{5.0, 6.0}));
  EXPECT_TRUE(views[0].row[2].empty());
}

TEST(JointViews, AUrArmHasTheCurrentOfItsMotorsAndItsTargets) {
  const auto views = views_of_json(
      "ur_msgs/RobotStateRTMsg",
      R"({"q_target": [1], "qd_target": [2], "m_target": [3], "q_actual": [4], "qd_actual": [5], "i_actual": [6]})");
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(views[0].row, (JointRow{{{1.0}, {2.0}, {}}}));
  EXPECT_EQ(views[1].row, (JointRow{{{4.0}, {5.0}, {6.0}}}));
}

TEST(JointViews, ATrajectoryIsACommandOnlyIfItHasOnePoint) {
  const std::string head = R"({"joint_names": ["a"], "points": [{"positions": [1], "velocities": [2]})";
  const auto one = views_of_json("trajectory_msgs/JointTrajectory", head + "]}");
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].role, TopicRole::reference);
  EXPECT_EQ(one[0].row, (JointRow{{{1.0}, {2.0}, {}}}));
  EXPECT_TRUE(views_of_json("trajectory_msgs/JointTrajectory", head + R"(, {"positions": [3]}]})").empty());
}

TEST(JointViews, NewNamesOfAControllerComeBeforeItsDeprecatedOnes) {
  const auto views =
      views_of_json("control_msgs/msg/JointTrajectoryControllerState",
                    R"({"joint_names": ["a"], "reference": {"positions": [1]}, "feedback": {"positions": [2]},
          "desired": {"positions": [3]}, "actual": {"positions": [4]}, "output": {"effort": []}})");
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(views[0].row[0], std::vector<double>{1.0});
  EXPECT_EQ(views[1].row[0], std::vector<double>{2.0});
}

TEST(JointViews, OtherTypesHaveNone) {
  EXPECT_FALSE(has_joint_views("sensor_msgs/msg/Imu"));
  EXPECT_TRUE(views_of_json("sensor_msgs/msg/Imu", R"({"q": [1]})").empty());
}

TEST(FieldPlace, HasTheIndicesOfEachArrayFromTheOutermostOn) {
  const auto place = field_place("drives[2].angle[11]");
  ASSERT_TRUE(place);
  EXPECT_EQ(place->path, "drives.angle");
  EXPECT_EQ(place->indices, (std::vector<std::uint32_t>{2, 11}));
  for (const char* wrong : {"", "[1]", "q[", "q[]", "q[-1]", "q[1", "q[1x]", "q[99999999999]"})
    EXPECT_FALSE(field_place(wrong)) << wrong;
}

TEST(MessageDefinition, HasFieldsInTheOrderOfTheTextWithoutConstantsAndDefaults) {
  const auto definition =
      parse_definition("a_msgs/msg/Thing",
                       "# about it\nuint8 MODE_A=1\nstring TEXT=\"x # y\"\nfloat64 x 1.5  # m\n"
                       "string<=10[<=3] names\nint8[4] four\nOther other\n"
                       "================\nMSG: a_msgs/Other\ntime stamp\n");
  ASSERT_TRUE(definition);
  const auto& fields = definition->groups[0].fields;
  ASSERT_EQ(fields.size(), 4U);
  EXPECT_EQ(fields[0].name, "x");
  EXPECT_EQ(fields[1].value, MessageValue::text);
  EXPECT_EQ(fields[1].count, MessageCount::listed);
  EXPECT_EQ(fields[2].size, 4U);
  EXPECT_EQ(definition->groups[static_cast<std::size_t>(fields[3].group)].type, "a_msgs/Other");
}

TEST(MessageDefinition, IsRefusedWithAnUnknownType) {
  EXPECT_FALSE(parse_definition("a_msgs/Thing", "Missing field\n"));
  EXPECT_FALSE(parse_definition("a_msgs/Thing", "wstring text\n"));
  EXPECT_FALSE(parse_definition("a_msgs/Thing", "float64\n"));
  EXPECT_FALSE(parse_definition("a_msgs/Thing", "float64[x] y\n"));
}

}  // namespace
}  // namespace faultline
