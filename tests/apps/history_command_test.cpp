// SPDX-License-Identifier: MIT
// faultline history on what faultline batch wrote.
#include <gtest/gtest.h>

#include "lib/core/atomic_file.hpp"
#include "tests/batch/batch_world.hpp"
#include "tests/support/json_schema.hpp"

namespace faultline {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class HistoryCommand : public testing::Test {
 protected:
  HistoryCommand() {
    world_.add_logs(6);
    EXPECT_LE(run_program(world_.command(world_.file("out"))).status, 1);
  }

  ProgramRun history(std::vector<std::string> more) const {
    more.insert(more.begin(), {"history", "--db", db_});
    return run_program(more);
  }

  BatchWorld world_;
  const std::string db_ = world_.file("robots.sqlite");
};

TEST_F(HistoryCommand, AddsABatchOnceAndWritesPageAndJson) {
  const std::string page = world_.file("robots.html"), json = world_.file("robots.json");
  const ProgramRun first = history({world_.file("out"), "-o", page, "--json", json});
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_TRUE(has(first.err, "6 added, 0 replaced, 0 known before")) << first.err;
  EXPECT_TRUE(has(first.out, ": 6 logs, last runs/day_2/run_5.csv; worst finding: free_swinging, joint 1"))
      << first.out;
  EXPECT_TRUE(has(read_file(page), "not every log contains a date"));
  EXPECT_FALSE(has(read_file(page) + read_file(json), world_.logs())) << "no path of this machine";
  EXPECT_FOLLOWS_SCHEMA({"history-1", json});
  const std::string before = read_file(db_), shown = read_file(page);
  const ProgramRun again = history({world_.file("out/index.ndjson"), "-o", page});
  EXPECT_TRUE(has(again.err, "0 added, 0 replaced, 6 known before")) << again.err;
  EXPECT_EQ(read_file(db_), before);
  EXPECT_EQ(read_file(page), shown);
}

TEST_F(HistoryCommand, IsShownWithoutResultsAndOfOneRobotAlone) {
  EXPECT_EQ(history({world_.file("out")}).status, 0);
  EXPECT_EQ(history({}).status, 0);
  const ProgramRun unknown = history({"--robot", "unknown"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(has(unknown.err, "is no robot of this history")) << unknown.err;
}

TEST_F(HistoryCommand, RefusesFilesThatAreNoResultsAndLeavesNoHistory) {
  const ProgramRun model = history({world_.model()});
  EXPECT_EQ(model.status, 3);
  EXPECT_TRUE(has(model.err, "is no diagnosis")) << model.err;
  const ProgramRun logs = history({world_.logs()});
  EXPECT_EQ(logs.status, 3);
  EXPECT_TRUE(has(logs.err, "contains no diagnosis")) << logs.err;
  EXPECT_FALSE(std::filesystem::exists(db_));
}

TEST_F(HistoryCommand, NoResultTakesThePlaceOfTheHistoryOrOfADiagnosis) {
  const ProgramRun same = history({world_.file("out"), "-o", db_});
  EXPECT_EQ(same.status, 2);
  EXPECT_TRUE(has(same.err, "is also the file of --db")) << same.err;
  EXPECT_EQ(history({world_.file("out"), "--json", world_.file("out/logs/x.json")}).status, 2);
}

}  // namespace
}  // namespace faultline
