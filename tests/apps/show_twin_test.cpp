// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/run_program.hpp"

namespace faultline {
namespace {

TEST(ShowTwin, NeedsNeitherLogsNorRobot) {
  const ProgramRun run = run_program({"learn", "--show-twin"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("torque_loss"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("pd_share"), std::string::npos) << run.out;
}

TEST(ShowTwin, PrintsOnlyJsonOnRequest) {
  const ProgramRun run = run_program({"learn", "--show-twin", "--json", "-"});
  EXPECT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json.at("twin").at("faults").at("torque_loss").at("size").at(0).at("high"), 0.9);
}

TEST(ShowTwin, LearnWithoutShowTwinRequiresItsArguments) {
  const ProgramRun run = run_program({"learn"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("required"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace faultline
