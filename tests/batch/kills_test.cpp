// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>

#include "lib/core/random.hpp"
#include "tests/batch/batch_world.hpp"
#include "tests/support/signalled_program.hpp"

namespace faultline {
namespace {

TEST(KilledBatch, ContinuesToTheSameBytesAfterAKillAtAnyTime) {
  const BatchWorld world;
  world.add_logs(12, 10.0);
  const auto start = std::chrono::steady_clock::now();
  run_program(world.command(world.file("whole"), {"--html", "--threads", "2"}));
  const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Random random(4);
  int kills = 0;
  for (int round = 0; round < 2; ++round) {
    const std::string out = world.file("out_" + std::to_string(round));
    for (int i = 0; i < 4; ++i)
      kills += ended_by(i % 2 ? SIGTERM : SIGKILL, whole_s * random.uniform(0.1, 0.6),
                        world.command(out, {"--html", "--threads", "2"}));
    const ProgramRun last = run_program(world.command(out, {"--html", "--threads", "2"}));
    EXPECT_EQ(last.status, 1) << last.err;
    EXPECT_EQ(differences(out, world.file("whole")), std::vector<std::string>{});
  }
  EXPECT_GE(kills, 2);
}

}  // namespace
}  // namespace faultline
