// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/core/atomic_file.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

const char* const kSpec = R"(
robot = "P"
duration_s = 6.0
sample_period_s = 0.01
[[run]]
name = "healthy"
)";

class RobotArgument : public testing::Test {
 protected:
  RobotArgument() {
    folder_.write("spec.toml", kSpec);
    simulated_ = run_program({"simulate", folder_.file("spec.toml"), "-o", folder_.file("logs")});
  }

  ProgramRun identify(const std::string& robot, const std::string& out) const {
    return run_program({"identify", folder_.file("logs/healthy.csv"), "--robot", robot, "-o", out});
  }

  TemporaryFolder folder_;
  ProgramRun simulated_;
};

TEST_F(RobotArgument, AxesAloneSpecifyARobotForSimulateAndIdentify) {
  ASSERT_EQ(simulated_.status, 0) << simulated_.err;
  const ProgramRun run = identify("P", folder_.file("identified.toml"));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(load_robot_file(folder_.file("identified.toml")).identified);
}

TEST_F(RobotArgument, IdentifyWritesAndReadsUrdfByTheExtensionOfTheFile) {
  const std::string urdf = folder_.file("identified.urdf");
  ASSERT_EQ(identify("P", urdf).status, 0);
  EXPECT_NE(read_file(urdf).find("<robot name="), std::string::npos);
  const ProgramRun run = identify(urdf, folder_.file("again.toml"));
  EXPECT_EQ(run.status, 0) << run.err;
}

TEST_F(RobotArgument, ABrokenUrdfIsAnInputError) {
  const std::string urdf = folder_.write("arm.urdf", "<robot name='arm'><link name='a'>");
  const ProgramRun run = identify(urdf, folder_.file("out.toml"));
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("arm.urdf, line 1"), std::string::npos) << run.err;
}

TEST_F(RobotArgument, SimulatedLogsOfACoupledRobotHoldTheSignalsOfItsDrives) {
  const std::string plain = read_file(folder_.file("logs/healthy.csv"));
  std::string spec = kSpec;
  spec.replace(spec.find("robot = \"P\"\n"), 12, "robot = {axes = \"P\", log = {coupling = [[2]]}}\n");
  folder_.write("spec.toml", spec);
  const ProgramRun run = run_program({"simulate", folder_.file("spec.toml"), "-o", folder_.file("drives")});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(read_file(folder_.file("drives/healthy.csv")), plain);
  folder_.write("robot.toml", "axes = \"P\"\n[log]\ncoupling = [[2]]\n");
  const std::string out = folder_.file("coupled.toml");
  const ProgramRun back = run_program(
      {"identify", folder_.file("drives/healthy.csv"), "--robot", folder_.file("robot.toml"), "-o", out});
  ASSERT_EQ(back.status, 0) << back.err;
  const Robot robot = load_robot_file(out);
  EXPECT_NEAR(robot.chain.links[0].mass, 1.0, 0.01);
  EXPECT_EQ(robot.log.coupling(0, 0), 2.0);
}

}  // namespace
}  // namespace faultline
