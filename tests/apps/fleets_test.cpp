// SPDX-License-Identifier: MIT
// Batches by engines of other authors have the bytes of one batch. An engine that is not installed is
// skipped.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/batch/batch_world.hpp"

namespace faultline {
namespace {

const std::string kFleets = FAULTLINE_SOURCE_DIR "/apps/fleets/";

int shell(const std::string& command) {
  return std::system(("bash -c '" + command + "' >/dev/null 2>&1").c_str());
}

bool is_installed(const std::string& engine) { return shell(engine + " --version") == 0; }

std::vector<std::string> differences_to_one_batch(const BatchWorld& world, const std::string& made) {
  run_program(world.command(world.file("whole")));
  return differences(made, world.file("whole"));
}

std::string snakemake(const BatchWorld& world) {
  return "cd " + world.file(".") + " && snakemake -s " + kFleets +
         "Snakefile -c 2 --config logs=" + world.logs() + " model=" + world.model() +
         " out=" + world.file("out") + " parts=3 faultline=" FAULTLINE_PROGRAM;
}

TEST(Fleets, SnakemakeGivesTheBytesOfOneBatch) {
  if (!is_installed("snakemake")) GTEST_SKIP() << "snakemake is missing";
  const BatchWorld world;
  world.add_logs(4);
  ASSERT_EQ(shell(snakemake(world)), 0);
  EXPECT_EQ(differences_to_one_batch(world, world.file("out/all")), std::vector<std::string>{});
}

TEST(Fleets, CwltoolGivesTheBytesOfOneBatch) {
  if (!is_installed("cwltool")) GTEST_SKIP() << "cwltool is missing";
  const BatchWorld world;
  world.add_logs(4);
  const std::string program = std::filesystem::path(FAULTLINE_PROGRAM).parent_path().string();
  ASSERT_EQ(
      shell("cd " + world.file(".") + " && PATH=" + program + ":$PATH cwltool --preserve-environment PATH " +
            kFleets + "batch.cwl --logs " + world.logs() + " --model " + world.model()),
      0);
  EXPECT_EQ(differences_to_one_batch(world, world.file("results")), std::vector<std::string>{});
}

TEST(Fleets, PartsByGnuParallelGiveTheBytesOfOneBatch) {
  if (!is_installed("parallel")) GTEST_SKIP() << "parallel is missing";
  const BatchWorld world;
  world.add_logs(4);
  const std::string program = FAULTLINE_PROGRAM;
  shell("parallel -j 2 " + program + " batch " + world.logs() + " --model " + world.model() + " -o " +
        world.file("out") + "/part-{} --shard {}/3 ::: 1 2 3");  // its status counts the parts with faults
  ASSERT_LE(shell(program + " batch merge " + world.file("out") + "/part-* -o " + world.file("out/all")),
            256);
  EXPECT_EQ(differences_to_one_batch(world, world.file("out/all")), std::vector<std::string>{});
}

TEST(Fleets, MultiqcShowsATableOfTheLogs) {
  if (!is_installed("multiqc")) GTEST_SKIP() << "multiqc is missing";
  const BatchWorld world;
  world.add_logs(4);
  run_program(world.command(world.file("out")));
  ASSERT_EQ(shell("cd " + world.file(".") + " && multiqc -f -o report " + world.file("out")), 0);
  const std::string page = read_file(world.file("report/multiqc_report.html"));
  EXPECT_NE(page.find("faultline_table"), std::string::npos);
  EXPECT_NE(page.find("run_1"), std::string::npos);
}

}  // namespace
}  // namespace faultline
