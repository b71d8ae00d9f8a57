// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "tests/formats/messages/made_recordings.hpp"

// Messages of controllers, as bytes by the rules of CDR and of ROS 1, and what the log says of them.
namespace faultline::made {
namespace {

/// Members of a message as ROS 2 writes them: little-endian, aligned to their size.
class Cdr {
 public:
  Cdr& word(std::uint32_t value) { return align(4).put(&value, sizeof value); }
  Cdr& number(double value) { return align(8).put(&value, sizeof value); }
  Cdr& numbers(const std::vector<double>& values) {
    word(static_cast<std::uint32_t>(values.size()));
    for (const double value : values) number(value);
    return *this;
  }
  Cdr& text(const std::string& value) {
    word(static_cast<std::uint32_t>(value.size() + 1));
    return put(value.c_str(), value.size() + 1);
  }
  Cdr& texts(const std::vector<std::string>& values) {
    word(static_cast<std::uint32_t>(values.size()));
    for (const std::string& value : values) text(value);
    return *this;
  }
  /// A header stamped 10 s and `k` ms.
  Cdr& header(int k) { return word(10).word(static_cast<std::uint32_t>(k) * 1'000'000).text("base"); }
  /// A trajectory_msgs/JointTrajectoryPoint.
  Cdr& point(const std::vector<double>& q, const std::vector<double>& dq, const std::vector<double>& tau) {
    return numbers(q).numbers(dq).numbers({}).numbers(tau).word(0).word(0);
  }
  std::string message() const { return std::string("\0\1\0\0", 4) + bytes_; }

 private:
  Cdr& align(std::size_t to) {
    bytes_.append((to - bytes_.size() % to) % to, '\0');
    return *this;
  }
  Cdr& put(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
    return *this;
  }
  std::string bytes_;
};

const std::string kRule =
    "================================================================================\n";
const std::string kHeaderText = kRule +
                                "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" +
                                kRule + "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
const std::string kPointText =
    kRule +
    "MSG: trajectory_msgs/JointTrajectoryPoint\n# Each array is empty or has a value a joint.\n"
    "float64[] positions\nfloat64[] velocities\nfloat64[] accelerations\nfloat64[] effort\n"
    "builtin_interfaces/Duration time_from_start\n" +
    kRule + "MSG: builtin_interfaces/Duration\nint32 sec\nuint32 nanosec\n";
/// A state with its definition, as far as a controller needs it.
const std::string kStateText =
    "std_msgs/Header header\nstring[] joint_names\ntrajectory_msgs/JointTrajectoryPoint reference\n"
    "trajectory_msgs/JointTrajectoryPoint feedback  # measured\n"
    "trajectory_msgs/JointTrajectoryPoint error\ntrajectory_msgs/JointTrajectoryPoint output\n" +
    kPointText + kHeaderText;
constexpr const char* kStateType = "control_msgs/msg/JointTrajectoryControllerState";
const std::vector<std::string> kJoints{"joint2", "joint1"};

std::string stated_topic(std::uint16_t id, const std::string& name, const std::string& type,
                         const std::string& definition, const std::string& encoding = "cdr") {
  ByteBuilder schema, channel;
  schema.put(id).put_text(type).put_text(encoding == "json" ? "jsonschema" : "ros2msg").put_text(definition);
  channel.put(id).put(id).put_text(name).put_text(encoding).put_text("");
  return record(McapOp::schema, schema.bytes()) + record(McapOp::channel, channel.bytes());
}

/// Positions of joint 2, then joint 1, at row k.
std::vector<double> at(double start, int k) { return {start + 1e-3 * k, start + 1.0 + 1e-3 * k}; }

std::string controller_state(int k, const std::vector<double>& torque) {
  return Cdr()
      .header(k)
      .texts(kJoints)
      .point(at(0.5, k), {5.0, 6.0}, {})
      .point(at(0.0, k), {1.0, 2.0}, {30.0, 40.0})
      .point({}, {}, {})
      .point({}, {}, torque)
      .message();
}

std::string controller_log(int rows, const std::vector<double>& torque) {
  std::string records = stated_topic(1, "/arm_controller/controller_state", kStateType, kStateText);
  for (int k = 0; k < rows; ++k) records += message(1, k, controller_state(k, torque));
  return mcap(records);
}

/// Value of a signal of joint j, from 0, in row r.
double signal(const JointSignals& signals, int j, int r) {
  return signals[static_cast<std::size_t>(j)][static_cast<std::size_t>(r)];
}

TEST(ControllerStates, FeedbackIsTheLogAndTheReferenceStandsBesideIt) {
  const Reading reading = read(controller_log(5, {}));
  ASSERT_EQ(reading.refused, "");
  ASSERT_EQ(reading.log.rows(), 5);
  // joint1 is the second of the messages.
  EXPECT_DOUBLE_EQ(signal(reading.log.q, 0, 3), 1.003);
  EXPECT_DOUBLE_EQ(signal(reading.log.q, 1, 3), 0.003);
  EXPECT_DOUBLE_EQ(signal(reading.log.dq, 0, 3), 2.0);
  EXPECT_DOUBLE_EQ(signal(reading.log.tau, 0, 3), 40.0);
  EXPECT_DOUBLE_EQ(signal(reading.log.q_ref, 0, 3), 1.503);
  EXPECT_DOUBLE_EQ(signal(reading.log.dq_ref, 1, 3), 5.0);
  EXPECT_NEAR(reading.log.time[3] - reading.log.time[0], 0.003, 1e-9);
}

TEST(ControllerStates, EffortOfTheOutputIsTheCommandedTorqueBesideTheMeasuredOne) {
  const Reading reading = read(controller_log(5, {7.0, 8.0}));
  ASSERT_EQ(reading.refused, "");
  EXPECT_DOUBLE_EQ(signal(reading.log.tau, 0, 2), 8.0);
  EXPECT_DOUBLE_EQ(signal(reading.log.tau_meas, 0, 2), 40.0);
}

TEST(ControllerStates, OutputWithoutNumbersLeavesTheMeasuredTorque) {
  const Reading reading = read(controller_log(5, {std::nan(""), std::nan("")}));
  ASSERT_EQ(reading.refused, "");
  EXPECT_DOUBLE_EQ(signal(reading.log.tau, 0, 2), 40.0);
  EXPECT_EQ(reading.log.tau_meas.size(), 0);
}

TEST(ControllerStates, OldNamesAndNoDefinitionAreReadAsWell) {
  std::string records = topic(1, "/arm_controller/state", kStateType);
  for (int k = 0; k < 5; ++k)
    records += message(1, k,
                       Cdr()
                           .header(k)
                           .texts(kJoints)
                           .point(at(0.5, k), {5.0, 6.0}, {})
                           .point(at(0.0, k), {1.0, 2.0}, {30.0, 40.0})
                           .point({}, {}, {})
                           .message());
  const Reading reading = read(mcap(records));
  ASSERT_EQ(reading.refused, "");
  ASSERT_EQ(reading.log.rows(), 5);
  EXPECT_DOUBLE_EQ(signal(reading.log.q, 0, 3), 1.003);
  EXPECT_DOUBLE_EQ(signal(reading.log.q_ref, 1, 3), 0.503);
  EXPECT_DOUBLE_EQ(signal(reading.log.tau, 1, 3), 30.0);
}

TEST(ControllerStates, JointStatesStayTheLogWithTheReferenceOfTheController) {
  std::string records =
      topic(2, "/joint_states") + stated_topic(1, "/arm_controller/controller_state", kStateType, kStateText);
  for (int k = 0; k < 8; ++k) {
    if (k % 2 == 0) records += message(1, k, controller_state(k, {}));
    records += message(2, k, joint_state(k, kJoints, at(3.0, k)));
  }
  const Reading reading = read(mcap(records));
  ASSERT_EQ(reading.refused, "");
  ASSERT_EQ(reading.log.rows(), 8);
  EXPECT_DOUBLE_EQ(signal(reading.log.q, 0, 5), 4.005);
  EXPECT_DOUBLE_EQ(signal(reading.log.q_ref, 0, 5), 1.504) << "of the latest message of the controller";
}

TEST(ControllerStates, TheTopicOfTheRobotFileNamesAControllerAsItIs) {
  std::string records =
      topic(2, "/joint_states") + stated_topic(1, "/arm_controller/controller_state", kStateType, kStateText);
  for (int k = 0; k < 4; ++k)
    records += message(1, k, controller_state(k, {})) + message(2, k, joint_state(k, kJoints, at(3.0, k)));
  OpenLogOptions options;
  options.recording.topic = "/arm_controller/controller_state";
  const Reading reading = read(mcap(records), options);
  ASSERT_EQ(reading.refused, "");
  EXPECT_DOUBLE_EQ(signal(reading.log.q, 0, 3), 1.003);
  EXPECT_DOUBLE_EQ(signal(reading.log.q_ref, 0, 3), 1.503);
}

TEST(ControllerStates, DynamicJointStatesAreReadByTheNamesOfTheirInterfaces) {
  std::string records = topic(1, "/dynamic_joint_states", "control_msgs/msg/DynamicJointState");
  for (int k = 0; k < 5; ++k)
    records += message(1, k,
                       Cdr()
                           .header(k)
                           .texts({"joint1", "tool_io", "joint2"})
                           .word(3)
                           .texts({"velocity", "position", "effort"})
                           .numbers({0.1, 1.0 + k, 10.0})
                           .texts({"digital_output"})
                           .numbers({1.0})
                           .texts({"position", "velocity"})
                           .numbers({2.0 + k, 0.2})
                           .message());
  const Reading reading = read(mcap(records));
  ASSERT_EQ(reading.refused, "");
  ASSERT_EQ(reading.log.joints(), 2);
  EXPECT_DOUBLE_EQ(signal(reading.log.q, 0, 3), 4.0);
  EXPECT_DOUBLE_EQ(signal(reading.log.q, 1, 3), 5.0);
  EXPECT_DOUBLE_EQ(signal(reading.log.dq, 1, 3), 0.2);
  EXPECT_DOUBLE_EQ(signal(reading.log.tau, 0, 3), 10.0);
  EXPECT_TRUE(std::isnan(signal(reading.log.tau, 1, 3)));
}

TEST(ControllerStates, ACutMessageIsCountedAsALostRow) {
  std::string records = stated_topic(1, "/arm_controller/controller_state", kStateType, kStateText);
  for (int k = 0; k < 6; ++k) {
    const std::string whole = controller_state(k, {});
    records += message(1, k, k == 3 ? whole.substr(0, whole.size() / 2) : whole);
  }
  const Reading reading = read(mcap(records));
  ASSERT_EQ(reading.refused, "");
  EXPECT_EQ(reading.log.rows(), 5);
  EXPECT_EQ(reading.rows_read, 6);
  EXPECT_NE(reading.message_of("message_damaged"), "");
}

TEST(ControllerStates, LengthsBeyondTheMessageAskForNoMemory) {
  std::string records = stated_topic(1, "/arm_controller/controller_state", kStateType, kStateText);
  records += message(1, 0, controller_state(0, {}));
  records += message(1, 1, Cdr().header(1).word(0xFFFFFFFF).message());
  records += message(1, 2, Cdr().header(2).texts(kJoints).word(0xFFFFFFFF).message());
  const Reading reading = read(mcap(records));
  ASSERT_EQ(reading.refused, "");
  EXPECT_EQ(reading.log.rows(), 1);
  EXPECT_EQ(reading.rows_read, 3);
}

// ---- Fields that the robot file names

/// Fields of the topic for the position, velocity and torque of two joints, by the names that are given.
OpenLogOptions mapped(const std::string& topic,
                      const std::vector<std::pair<std::string, std::string>>& fields) {
  OpenLogOptions options;
  for (const auto& [channel, field] : fields) {
    ColumnSpec spec;
    spec.topic = topic;
    spec.name = topic + "/" + field;
    options.columns[channel] = spec;
    options.recording.fields.push_back({topic, field});
  }
  return options;
}

const std::string kDriveText =
    "# A maker's own message.\nuint8 READY=1\nuint8 state\nfloat32 bus_voltage 48.0\n"
    "drives_msgs/Drive[] drives\n" +
    kRule + "MSG: drives_msgs/Drive\nstring<=20 name\nfloat64[2] angle\nint16 current\n";

std::string drive_state(int k) {
  std::string out("\0\1\0\0", 4);
  ByteBuilder bytes;
  // state, padding to 4, voltage, number of drives, then each drive: text, padding to 8, two doubles, int16.
  bytes.put(std::uint8_t{1}).put(std::uint8_t{0}).put(std::uint16_t{0});
  bytes.put(std::bit_cast<std::uint32_t>(48.0F)).put(std::uint32_t{2});
  std::string body = bytes.bytes();
  for (int d = 0; d < 2; ++d) {
    body.append((4 - body.size() % 4) % 4, '\0');
    ByteBuilder drive;
    drive.put(std::uint32_t{2}).put_bytes(std::string(1, static_cast<char>('a' + d)) + '\0');
    body += drive.bytes();
    body.append((8 - body.size() % 8) % 8, '\0');
    ByteBuilder rest;
    rest.put(std::bit_cast<std::uint64_t>(0.1 * d + 1e-3 * k)).put(std::bit_cast<std::uint64_t>(9.0));
    rest.put(static_cast<std::uint16_t>(static_cast<std::int16_t>(-100 * (d + 1) + k)));
    body += rest.bytes();
  }
  return out + body;
}

std::string drive_log() {
  std::string records = stated_topic(1, "/drives", "drives_msgs/msg/DriveStates", kDriveText);
  for (int k = 0; k < 5; ++k) records += message(1, k, drive_state(k));
  return mcap(records);
}

TEST(MessageFields, ANumberInsideAnArrayOfAMakersOwnMessageIsAColumn) {
  const Reading reading = read(drive_log(), mapped("/drives", {{"q1", "drives[0].angle[0]"},
                                                               {"q2", "drives[1].angle[0]"},
                                                               {"tau1", "drives[0].current"},
                                                               {"tau2", "drives[1].current"}}));
  ASSERT_EQ(reading.refused, "");
  ASSERT_EQ(reading.log.rows(), 5);
  EXPECT_DOUBLE_EQ(signal(reading.log.q, 0, 4), 0.004);
  EXPECT_DOUBLE_EQ(signal(reading.log.q, 1, 4), 0.104);
  EXPECT_DOUBLE_EQ(signal(reading.log.tau, 0, 4), -96.0);
  EXPECT_DOUBLE_EQ(signal(reading.log.tau, 1, 4), -196.0);
}

TEST(MessageFields, AFieldThatIsMissingIsRefusedWithTheFieldsThatAreThere) {
  const Reading reading = read(drive_log(), mapped("/drives", {{"q1", "drives[0].position"}}));
  EXPECT_NE(reading.refused.find("has no field \"drives[0].position\" on the topic \"/drives\""),
            std::string::npos)
      << reading.refused;
  EXPECT_NE(reading.refused.find("drives[0].angle[0]"), std::string::npos) << reading.refused;
}

TEST(MessageFields, ATopicThatIsMissingIsRefused) {
  const Reading reading = read(drive_log(), mapped("/drive", {{"q1", "drives[0].angle[0]"}}));
  EXPECT_NE(reading.refused, "");
  const Reading beside = read(controller_log(5, {}), mapped("/other", {{"tau1", "x"}}));
  EXPECT_NE(beside.refused.find("no messages of this topic"), std::string::npos) << beside.refused;
}

TEST(MessageFields, AFieldBesideJointStatesIsATorqueOfTheirRows) {
  std::string records =
      topic(2, "/joint_states") + stated_topic(1, "/drives", "drives_msgs/msg/DriveStates", kDriveText);
  for (int k = 0; k < 5; ++k)
    records +=
        message(1, k, drive_state(k)) + message(2, k, joint_state(k, {"joint1", "joint2"}, at(3.0, k)));
  const Reading reading =
      read(mcap(records), mapped("/drives", {{"tau1", "drives[0].current"}, {"tau2", "drives[1].current"}}));
  ASSERT_EQ(reading.refused, "");
  ASSERT_EQ(reading.log.rows(), 5);
  EXPECT_DOUBLE_EQ(signal(reading.log.q, 0, 4), 3.004);
  EXPECT_DOUBLE_EQ(signal(reading.log.tau, 1, 4), -196.0);
}

TEST(MessageFields, JsonMessagesHaveFieldsWithoutADefinition) {
  std::string records = stated_topic(1, "/arm", "Arm", "{}", "json");
  for (int k = 0; k < 4; ++k)
    records += message(
        1, k, "{\"arm\": {\"q\": [" + std::to_string(k) + ", 2.5], \"axes\": [{\"i\": 7}, {\"i\": 8}]}}");
  const Reading reading = read(
      mcap(records), mapped("/arm", {{"q1", "arm.q[0]"}, {"q2", "arm.q[1]"}, {"tau1", "arm.axes[1].i"}}));
  ASSERT_EQ(reading.refused, "");
  EXPECT_DOUBLE_EQ(signal(reading.log.q, 0, 3), 3.0);
  EXPECT_DOUBLE_EQ(signal(reading.log.tau, 0, 3), 8.0);
}

TEST(MessageFields, ADefinitionThatContainsItselfIsNoDefinition) {
  std::string records = stated_topic(1, "/loop", "a/msg/Loop", "a/Loop[] inner\nfloat64 x\n");
  for (int k = 0; k < 4; ++k) records += message(1, k, Cdr().word(0).number(1.0).message());
  const Reading reading = read(mcap(records), mapped("/loop", {{"q1", "x"}}));
  EXPECT_NE(reading.refused, "");
}

}  // namespace
}  // namespace faultline::made
