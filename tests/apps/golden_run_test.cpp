// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/batch/batch_world.hpp"
#include "tests/support/json_schema.hpp"

namespace faultline {
namespace {

TEST(GoldenRun, NewRunsAreHeldAgainstTheRecordedHealthyOnes) {
  const BatchWorld world;
  const TemporaryFolder folder;
  const std::string gold = folder.file("gold");
  const ProgramRun recorded = run_program(
      {"golden", "record", write_motion(folder, "a.csv", 1, false), write_motion(folder, "b.csv", 2, false),
       write_motion(folder, "c.csv", 3, false), write_motion(folder, "fault.csv", 4, true), "--model",
       world.model(), "-o", gold, "--no-identification"});
  ASSERT_EQ(recorded.status, 0) << recorded.err;
  const std::string good = write_motion(folder, "good.csv", 5, false),
                    bad = write_motion(folder, "bad.csv", 6, true),
                    other = write_motion(folder, "other.csv", 7, false, 0.02);
  const ProgramRun same = run_program({"golden", "run", good, "--against", gold});
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  EXPECT_NE(same.out.find("1 of 1 run as recorded."), std::string::npos) << same.out;
  const std::string json = folder.file("runs.json"), junit = folder.file("runs.xml");
  const ProgramRun run =
      run_program({"golden", "run", good, bad, other, "--against", gold, "--json", json, "--junit", junit});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_NE(run.out.find("leaves its tolerance at 2."), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("1 of 3 runs as recorded."), std::string::npos) << run.out;
  EXPECT_FOLLOWS_SCHEMA({"golden-runs-1", json});
  EXPECT_NE(read_file(junit).find("<failure type=\"position\""), std::string::npos);
  write_file(gold + "/runs.toml", "[[widen]]\nsignal = \"torque\"\nfactor = 3.0\n");
  const ProgramRun refused = run_program({"golden", "run", good, "--against", gold});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("reason"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace faultline
