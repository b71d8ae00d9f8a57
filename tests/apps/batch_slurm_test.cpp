// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/batch/batch_world.hpp"

namespace faultline {
namespace {

int shell(const std::string& command) {
  return std::system(("bash -c '" + command + "' >/dev/null 2>&1").c_str());
}

/// What a user exports before he submits the script.
std::string settings(const BatchWorld& world) {
  return "export FAULTLINE=" FAULTLINE_PROGRAM " LOGS=" + world.logs() + " MODEL=" + world.model() +
         " OUT=" + world.file("out") + " PARTS=3 BATCH_OPTIONS=--html; ";
}

const std::string kScript = FAULTLINE_SOURCE_DIR "/apps/batch_slurm.sh";

TEST(BatchSlurm, TheScriptRunsAShardPerTaskAndMergesWithoutATaskNumber) {
  const BatchWorld world;
  world.add_logs(4);
  const std::string in = settings(world);
  for (const char* task : {"2", "1", "2"})
    EXPECT_EQ(shell(in + "SLURM_ARRAY_TASK_ID=" + task + " bash " + kScript), 0) << task;
  EXPECT_NE(shell(in + "unset SLURM_ARRAY_TASK_ID; bash " + kScript), 0) << "merged without part 3";
  EXPECT_EQ(shell(in + "SLURM_ARRAY_TASK_ID=3 bash " + kScript), 0);
  EXPECT_EQ(shell(in + "unset SLURM_ARRAY_TASK_ID; bash " + kScript), 0);
  run_program(world.command(world.file("whole"), {"--html"}));
  EXPECT_EQ(differences(world.file("out/all"), world.file("whole")), std::vector<std::string>{});
  EXPECT_NE(shell(in + "MODEL=/none SLURM_ARRAY_TASK_ID=1 bash " + kScript), 0);
}

TEST(BatchSlurm, AnArrayJobAndItsMergeEqualOneBatchOnARealCluster) {
  if (shell("sbatch --version && sinfo -h | grep -q .") != 0) GTEST_SKIP() << "no Slurm answers here";
  const BatchWorld world;
  world.add_logs(4);
  const std::string quiet = " --cpus-per-task=1 -o /dev/null ";
  EXPECT_EQ(shell(settings(world) + "job=$(sbatch --parsable --array=1-3" + quiet + kScript +
                  ") && sbatch --wait --dependency=afterok:$job --kill-on-invalid-dep=yes" + quiet + kScript),
            0);
  run_program(world.command(world.file("whole"), {"--html"}));
  EXPECT_EQ(differences(world.file("out/all"), world.file("whole")), std::vector<std::string>{});
}

}  // namespace
}  // namespace faultline
