// SPDX-License-Identifier: MIT
// Bags that the programs of ROS wrote, made at test time where they are installed (Debian: python3-rosbag,
// python3-sensor-msgs), and recordings of real robots.
#include <gtest/gtest.h>

#include <cmath>

#include "formats/open_log.hpp"
#include "tests/support/run_python.hpp"
#include "tests/support/shared_data.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

constexpr const char* kWriteBags = R"(
import rosbag
import rospy
from sensor_msgs.msg import JointState

for packing in ('none', 'bz2', 'lz4'):
    with rosbag.Bag(packing + '.bag', 'w', compression=packing, chunk_threshold=2000) as bag:
        for k in range(100):
            m = JointState()
            m.header.stamp = rospy.Time(10, k * 1000000)
            m.header.frame_id = 'base'
            m.name = ['b', 'a']
            m.position = [k * 0.5, -k * 0.25]
            m.velocity = [1.0, 2.0]
            m.effort = [] if k == 50 else [k * 1.0, 3.0]
            bag.write('/joint_states', m, rospy.Time(10, k * 1000000 + 500))
)";

TEST(RosbagOfRos, IsReadWithAnyCompression) {
  const TemporaryFolder folder;
  if (!run_python(folder, kWriteBags)) GTEST_SKIP() << "no Python with rosbag and sensor_msgs";
  OpenLogOptions options;
  options.recording.joints = {"a", "b"};
  for (const char* packing : {"none", "bz2", "lz4"}) {
    const auto source = open_log(folder.file(std::string(packing) + ".bag"), options);
    const Log log = read_all(*source);
    ASSERT_EQ(log.rows(), 100) << packing;
    EXPECT_EQ(log.time[7], 10.007);
    EXPECT_EQ(log.q[0][7], -1.75);
    EXPECT_EQ(log.q[1][7], 3.5);
    EXPECT_EQ(log.tau[1][99], 99.0);
    EXPECT_TRUE(std::isnan(log.tau[0][50]));
    EXPECT_EQ(source->identity().rows_read, 100);
  }
}

TEST(RosbagOfRealRobots, IsReadCompletely) {
  const std::filesystem::path data = shared_data();
  if (data.empty()) GTEST_SKIP() << "the shared data are not there";
  const auto one = open_log(data / "ur3-rosbag1/id1.bag");
  EXPECT_EQ(read_all(*one).rows(), 5941);
  EXPECT_EQ(one->issues().rows_dropped(), 0);
  const auto two = open_log(data / "ur10-panda-rosbag2/ur10_exciting_trajectory.db3");
  const Log log = read_all(*two);
  EXPECT_EQ(log.rows(), 3441);
  EXPECT_EQ(log.joints(), 6);
  EXPECT_EQ(two->issues().find("pages_damaged"), nullptr);
  EXPECT_EQ(read_all(*open_log(data / "mcap-db3-samples/test_bag_mcap.mcap")).q[1],
            (std::vector<double>{0.2, 0.2}));
}

}  // namespace
}  // namespace faultline
