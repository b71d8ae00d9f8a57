// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/formats/messages/made_recordings.hpp"
#include "tests/support/shared_data.hpp"

// Fields of messages in recordings that other programs wrote.
namespace faultline::made {
namespace {

Reading read_shared(const std::string& file, const std::string& topic, const std::string& field) {
  OpenLogOptions options;
  ColumnSpec spec;
  spec.topic = topic;
  spec.name = topic + "/" + field;
  options.columns["q1"] = spec;
  options.recording = {topic, {}, {}, {{topic, field}}};
  return read_file(file, options);
}

TEST(OtherRecordings, APoseOfTurtlesimBeginsInTheMiddleOfItsWindow) {
  const std::filesystem::path data = shared_data();
  if (data.empty()) return;
  for (const char* file : {"example.bag", "example-lz4.bag", "example-bz2.bag"}) {
    const Reading reading = read_shared((data / "rosbag1-samples" / file).string(), "/turtle1/pose", "x");
    ASSERT_EQ(reading.refused, "");
    // The window is 11.088889 wide (turtlesim).
    EXPECT_NEAR(reading.log.q[0].front(), 11.088889 / 2, 1e-5) << file;
    EXPECT_EQ(reading.rows_read, 1344) << file;
  }
}

TEST(OtherRecordings, BothContainersOfRosbag2HoldTheSameFields) {
  if (shared_data().empty()) return;
  const std::filesystem::path data = shared_data() / "mcap-db3-samples";
  struct Field {
    const char *topic, *name;
  };
  for (const Field& field :
       {Field{"/test/geometry_msgs/accel_stamped", "accel.linear.x"},
        Field{"/test/sensor_msgs/battery_state", "voltage"}, Field{"/test/sensor_msgs/camera_info", "k[4]"},
        Field{"/test/sensor_msgs/imu", "orientation_covariance[8]"},
        Field{"/test/geometry_msgs/polygon", "points[1].x"},
        Field{"/test/sensor_msgs/joint_state", "position[0]"}}) {
    const Reading of_mcap = read_shared((data / "test_bag_mcap.mcap").string(), field.topic, field.name);
    const Reading of_sqlite = read_shared((data / "test_bag_sqlite3.db3").string(), field.topic, field.name);
    ASSERT_EQ(of_mcap.refused, "") << field.topic;
    ASSERT_EQ(of_sqlite.refused, "") << field.topic;
    ASSERT_EQ(of_mcap.log.q[0].size(), 2U) << field.topic;
    EXPECT_EQ(of_mcap.log.q[0], of_sqlite.log.q[0]) << field.topic;
    EXPECT_NE(of_mcap.log.q[0][0], 0.0) << field.topic;
  }
}

}  // namespace
}  // namespace faultline::made
