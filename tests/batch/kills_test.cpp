// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "lib/core/random.hpp"
#include "tests/batch/batch_world.hpp"

namespace faultline {
namespace {

/// Starts the program and ends it by SIGKILL after a while, unless it has ended before.
bool killed_after(const std::vector<std::string>& arguments, double seconds) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::vector<char*> argv{const_cast<char*>(FAULTLINE_PROGRAM)};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr)) ::_exit(126);
    ::execv(FAULTLINE_PROGRAM, argv.data());
    ::_exit(127);
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status);
}

TEST(BatchKills, KilledAtAnyMomentItGoesOnToTheSameBytes) {
  const BatchWorld world;
  world.add_logs(12, 20.0);
  const auto start = std::chrono::steady_clock::now();
  run_program(world.command(world.file("whole"), {"--html", "--threads", "2"}));
  const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Random random(4);
  int kills = 0;
  for (int round = 0; round < 2; ++round) {
    const std::string out = world.file("out_" + std::to_string(round));
    for (int i = 0; i < 4; ++i)
      kills +=
          killed_after(world.command(out, {"--html", "--threads", "2"}), whole_s * random.uniform(0.1, 0.6));
    const ProgramRun last = run_program(world.command(out, {"--html", "--threads", "2"}));
    EXPECT_EQ(last.status, 1) << last.err;
    EXPECT_EQ(differences(out, world.file("whole")), std::vector<std::string>{});
  }
  EXPECT_GE(kills, 2);
}

}  // namespace
}  // namespace faultline
