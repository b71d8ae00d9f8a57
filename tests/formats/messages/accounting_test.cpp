// SPDX-License-Identifier: MIT
// Whatever a recording holds, each of its joint states is a row of the log or is listed among the issues.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/formats/messages/made_recordings.hpp"

namespace faultline {
namespace {

const std::vector<std::string> kArm{"joint_1", "joint_2"}, kRenamed{"arm_joint_1", "arm_joint_2"};

/// Rows that were read are rows of the log, or listed; and they are all that the recording has.
void expect_whole(const made::Reading& reading, int messages) {
  EXPECT_EQ(reading.refused, "");
  EXPECT_EQ(reading.rows_read, messages);
  EXPECT_EQ(reading.rows_read, reading.log.rows() + reading.issues.rows_dropped());
}

std::string mcap_of(const std::string& messages) {
  return made::mcap(made::topic(1, "/joint_states") + messages);
}

TEST(MessageAccounting, TwoRecordingsInOneMcapFileAreBothRead) {
  const std::string first = mcap_of(made::chunk(made::states(1, 0, 100, kArm)));
  // The second one gives the number of the joint states to another topic.
  const std::string second =
      made::mcap(made::topic(1, "/image", "sensor_msgs/msg/Image") + made::topic(2, "/joint_states") +
                 made::message(1, 0, "an image") + made::states(2, 100, 60, kArm));
  const made::Reading reading = made::read(first + second);
  expect_whole(reading, 160);
  EXPECT_EQ(reading.log.rows(), 160);
  EXPECT_NEAR(reading.log.time.back(), 10.159, 1e-9);
  EXPECT_NE(reading.message_of("recordings_joined"), "");
  EXPECT_EQ(reading.message_of("message_damaged"), "");
}

TEST(MessageAccounting, ARecordingAfterACutOneIsRead) {
  const std::string first = mcap_of(made::states(1, 0, 100, kArm));
  const std::string second = mcap_of(made::states(1, 100, 60, kArm));
  const made::Reading reading = made::read(first.substr(0, first.size() - 500) + second);
  EXPECT_GE(reading.log.rows(), 155);
  EXPECT_NE(reading.message_of("records_damaged"), "");
}

TEST(MessageAccounting, BytesAfterARecordingAreReported) {
  const made::Reading reading = made::read(mcap_of(made::states(1, 0, 100, kArm)) + "something else");
  expect_whole(reading, 100);
  EXPECT_NE(reading.message_of("trailing_bytes"), "");
}

TEST(MessageAccounting, TwoBagsInOneFileAreBothRead) {
  std::string first = made::connection(0, "/joint_states"),
              second =
                  made::connection(0, "/image", "sensor_msgs/Image") + made::connection(1, "/joint_states");
  for (int k = 0; k < 100; ++k) first += made::bag_state(0, k, kArm, 0.0);
  for (int k = 100; k < 160; ++k) second += made::bag_state(1, k, kArm, 0.0);
  const made::Reading reading =
      made::read(made::bag(made::bag_chunk(first)) + made::bag(made::bag_chunk(second)));
  expect_whole(reading, 160);
  EXPECT_EQ(reading.log.rows(), 160);
  EXPECT_NE(reading.message_of("recordings_joined"), "");
}

TEST(MessageAccounting, JointsThatChangeTheirNamesAreListed) {
  const made::Reading reading =
      made::read(mcap_of(made::states(1, 0, 178, kArm) + made::states(1, 178, 96, kRenamed)));
  expect_whole(reading, 274);
  EXPECT_EQ(reading.log.rows(), 178);
  ASSERT_TRUE(reading.issues.find("joints_changed"));
  EXPECT_EQ(reading.issues.find("joints_changed")->rows_dropped, 96);
  EXPECT_EQ(reading.issues.find("joints_changed")->severity, Severity::severe);
  EXPECT_NE(reading.message_of("joints_changed").find("arm_joint_1"), std::string::npos);
}

TEST(MessageAccounting, JointsThatChangeTheirNamesForAWhileAreListed) {
  const made::Reading reading = made::read(mcap_of(
      made::states(1, 0, 100, kArm) + made::states(1, 100, 50, kRenamed) + made::states(1, 150, 100, kArm)));
  expect_whole(reading, 250);
  EXPECT_EQ(reading.log.rows(), 200);
}

TEST(MessageAccounting, JointNamesThatAppearLateAreListed) {
  const made::Reading reading =
      made::read(mcap_of(made::states(1, 0, 4100, kArm) + made::states(1, 4100, 96, kRenamed)));
  expect_whole(reading, 4196);
  EXPECT_EQ(reading.log.rows(), 4100);
  EXPECT_EQ(reading.issues.find("joints_appear_late")->rows_dropped, 96);
}

TEST(MessageAccounting, MessagesOfATopicThatReplacesAnotherAreListed) {
  const made::Reading reading =
      made::read(made::mcap(made::topic(1, "/joint_states") + made::topic(2, "/arm/joint_states") +
                            made::states(1, 0, 178, kArm) + made::states(2, 178, 96, kArm)));
  expect_whole(reading, 274);
  EXPECT_EQ(reading.log.rows(), 178);
  EXPECT_NE(reading.message_of("joints_changed").find("/arm/joint_states"), std::string::npos);
}

TEST(MessageAccounting, AGripperAmongTheJointStatesIsNotALoss) {
  std::string messages;
  for (int k = 0; k < 300; ++k) {
    messages += made::states(1, k, 1, kArm);
    for (int g = 0; k % 10 == 0 && g < 5; ++g)
      messages += made::message(1, k, made::joint_state(k, {"finger"}, {0.04}));
  }
  const made::Reading reading = made::read(mcap_of(messages));
  expect_whole(reading, 300);
  EXPECT_EQ(reading.log.rows(), 300);
  EXPECT_EQ(reading.message_of("joints_changed"), "");
  // Of five messages between two rows one stands in a row.
  ASSERT_TRUE(reading.issues.find("messages_between_rows"));
  EXPECT_EQ(reading.issues.find("messages_between_rows")->count, 30 * 4);
}

TEST(MessageAccounting, CommandsAfterTheLastStateAreNotRows) {
  const made::Reading reading =
      made::read(made::mcap(made::topic(1, "/joint_states") + made::topic(2, "/joint_commands") +
                            made::states(1, 0, 100, kArm) + made::states(2, 100, 50, kArm)));
  expect_whole(reading, 100);
}

TEST(MessageAccounting, TwoPublishersOnOneTopicAreReported) {
  std::string mcap, bag = made::connection(0, "/joint_states") + made::connection(1, "/joint_states");
  for (int k = 0; k < 100; ++k) {
    mcap += made::states(1, 2 * k, 1, kArm, 0.0) + made::states(1, 2 * k + 1, 1, kArm, 0.7);
    bag += made::bag_state(0, 2 * k, kArm, 0.0) + made::bag_state(1, 2 * k + 1, kArm, 0.7);
  }
  for (const std::string& bytes : {mcap_of(mcap), made::bag(made::bag_chunk(bag))}) {
    const made::Reading reading = made::read(bytes);
    expect_whole(reading, 200);
    ASSERT_TRUE(reading.issues.find("publishers_mixed"));
    EXPECT_EQ(reading.issues.find("publishers_mixed")->severity, Severity::severe);
  }
}

TEST(MessageAccounting, AnEncoderBetweenTwoCodesIsNotASecondPublisher) {
  std::string messages;
  for (int k = 0; k < 200; ++k) messages += made::states(1, k, 1, kArm, k % 2 ? 1e-4 : 0.0);
  EXPECT_EQ(made::read(mcap_of(messages)).message_of("publishers_mixed"), "");
}

/// Any order of what several publishers send, with damage among it.
TEST(MessageAccounting, HoldsForAnyMixtureOfPublishers) {
  std::uint32_t state = 1;
  const auto draw = [&](int below) {
    state = 1664525 * state + 1013904223;
    return static_cast<int>((state >> 8) % static_cast<std::uint32_t>(below));
  };
  for (int trial = 0; trial < 40; ++trial) {
    std::string messages = made::topic(2, "/other_states");
    const std::vector<std::vector<std::string>> lists{
        kArm, kRenamed, {"finger"}, {"joint_1"}, {"joint_2", "wrist"}};
    int of_topic = 0;
    for (int run = 0, k = 0; run < 12; ++run) {
      const auto& names = lists[static_cast<std::size_t>(draw(5))];
      const int count = 1 + draw(60), channel = draw(4) == 0 ? 2 : 1;
      for (int i = 0; i < count; ++i, ++k) {
        std::string bytes = made::joint_state(k, names, std::vector<double>(names.size(), 1e-3 * k));
        if (draw(40) == 0) bytes.resize(bytes.size() / 2);
        messages += made::message(static_cast<std::uint16_t>(channel), k, bytes);
        of_topic += channel == 1;
      }
    }
    const made::Reading reading = made::read(mcap_of(messages));
    if (!reading.refused.empty()) continue;
    EXPECT_EQ(reading.rows_read, reading.log.rows() + reading.issues.rows_dropped()) << trial;
    std::int64_t beside = 0;
    for (const Issue& issue : reading.issues.all())
      if (issue.code == "messages_between_rows") beside += issue.count;
    EXPECT_GE(reading.rows_read + beside, reading.log.rows()) << trial;
  }
}

TEST(MessageAccounting, ASecondDatabaseInOneFileIsReported) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.db3");
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
  sqlite3_exec(
      db,
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name, type, serialization_format);"
      "INSERT INTO topics VALUES(1, '/joint_states', 'sensor_msgs/msg/JointState', 'cdr');"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)",
      nullptr, nullptr, nullptr);
  sqlite3_stmt* insert = nullptr;
  sqlite3_prepare_v2(db, "INSERT INTO messages VALUES(?1, 1, ?1, ?2)", -1, &insert, nullptr);
  for (int k = 1; k <= 50; ++k) {
    const std::string bytes = made::joint_state(k, kArm, {0.1, 0.2});
    sqlite3_bind_int(insert, 1, k);
    sqlite3_bind_blob(insert, 2, bytes.data(), static_cast<int>(bytes.size()), SQLITE_TRANSIENT);
    sqlite3_step(insert);
    sqlite3_reset(insert);
  }
  sqlite3_finalize(insert);
  sqlite3_close(db);
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const made::Reading one = made::read(bytes), two = made::read(bytes + bytes);
  expect_whole(one, 50);
  EXPECT_EQ(one.message_of("recordings_joined"), "");
  expect_whole(two, 50);
  EXPECT_NE(two.message_of("recordings_joined").find("--then"), std::string::npos);
}

}  // namespace
}  // namespace faultline
