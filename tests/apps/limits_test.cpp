// SPDX-License-Identifier: MIT
#include "tests/support/limits.hpp"

#include <gtest/gtest.h>

#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

const std::string kBench = FAULTLINE_SOURCE_DIR "/sample_logs/bench/";

std::vector<std::string> identify(const std::string& out, int logs) {
  std::vector<std::string> command = {"identify", "--robot", kBench + "robot.toml", "-o", out};
  for (int i = 0; i < logs; ++i) command.push_back(kBench + "healthy_1.csv");
  return command;
}

TEST(ResourceLimits, IdentifyGivesTheSameRobotIfNoThreadCanStart) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(identify(folder.file("usual.toml"), 1)).status, 0);
  const Limit limit(RLIMIT_STACK, kImpossibleStack);
  const ProgramRun run = run_program(identify(folder.file("alone.toml"), 1));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read_file(folder.file("alone.toml")), read_file(folder.file("usual.toml")));
}

TEST(ResourceLimits, IdentifyReadsMoreLogsThanTheProcessMayOpenAtOnce) {
  const TemporaryFolder folder;
  const Limit limit(RLIMIT_NOFILE, 20);
  const ProgramRun run = run_program(identify(folder.file("r.toml"), 40));
  EXPECT_EQ(run.status, 0) << run.err;
}

}  // namespace
}  // namespace faultline
