// SPDX-License-Identifier: MIT
#include "lib/batch/batch_summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

using Json = nlohmann::json;

BatchRow row(const std::string& log, const std::string& verdict, double residual) {
  BatchRow made;
  made.log = log;
  made.verdict = verdict;
  if (verdict == "healthy" || verdict == "faulty") {
    made.start_s = 100.0;
    made.end_s = 1900.0;
    made.residual_rms = {0.5, residual};
  }
  if (verdict == "faulty") made.faults = {{{FaultKind::locked, 2_joint}, 1.0, 1.1, 2.0, 0.9}};
  return made;
}

std::vector<BatchRow> rows() {
  std::vector<BatchRow> all = {row("a/1.csv", "healthy", 1.0), row("a/2.csv", "faulty", 5.0),
                               row("b/3.csv", "faulty", 3.0), row("b/4.csv", "unusable", 0.0),
                               row("5.csv", "inconclusive", 0.0)};
  all[2].faults.push_back({{FaultKind::unknown, Joint()}, 2.0, 2.1, 3.0, 0.5});
  return all;
}

BatchFacts facts() {
  BatchFacts made;
  made.models = {{"bench", "aa", "bb"}};
  made.program_version = "1";
  made.options = "--classify evidence";
  made.logs = 5;
  made.shard = 1;
  made.shards = 2;
  return made;
}

TEST(BatchSummary, TextNamesTheFirstUnusableLogsWithTheirReasonsAndCountsTheOthers) {
  std::vector<BatchRow> all;
  for (int i = 1; i <= 7; ++i) {
    all.push_back(row("cut/" + std::to_string(i) + ".csv", "unusable", 0.0));
    all.back().reason = "row 3 is cut";
  }
  const std::string text = to_text(summary_of(all, facts()));
  EXPECT_NE(text.find("not diagnosed: cut/1.csv: row 3 is cut\n"), std::string::npos) << text;
  EXPECT_NE(text.find("not diagnosed: cut/5.csv: row 3 is cut\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("cut/6.csv"), std::string::npos) << text;
  EXPECT_NE(text.find("and 2 more without a diagnosis; index.csv lists the reason of each\n"),
            std::string::npos)
      << text;
}

TEST(BatchSummary, TextNamesTheModelThatCanCallNoLogHealthyAndWhy) {
  BatchFacts doubtful = facts();
  doubtful.models[0].grave_doubts = {"the logs contradict each other"};
  const std::string text = to_text(summary_of(rows(), doubtful));
  EXPECT_NE(text.find("no log can be called healthy by bench: the logs contradict each other\n"),
            std::string::npos)
      << text;
}

TEST(BatchSummary, CountsVerdictsFoldersAndKinds) {
  const BatchSummary summary = summary_of(rows(), facts());
  EXPECT_EQ(summary.all.logs, 5);
  EXPECT_EQ(summary.all.healthy, 1);
  EXPECT_EQ(summary.all.faulty, 2);
  EXPECT_EQ(summary.all.unusable, 1);
  EXPECT_EQ(summary.all.inconclusive, 1);
  EXPECT_EQ(summary.all.faults, 3);
  EXPECT_DOUBLE_EQ(summary.all.hours, 1.5);
  EXPECT_EQ(summary.all.median_residual, 3.0);
  EXPECT_EQ(summary.all.largest_residual, 5.0);
  ASSERT_EQ(summary.folders.size(), 3u);
  EXPECT_EQ(summary.folders.at("a").faulty, 1);
  EXPECT_EQ(summary.folders.at("").inconclusive, 1);
  EXPECT_EQ(summary.kinds.at("locked").at(2_joint), 2);
  EXPECT_EQ(summary.kinds.at("unknown").at(Joint()), 1);
}

TEST(BatchSummary, TheWorstLogDecidesTheStatus) {
  std::vector<BatchRow> some = rows();
  EXPECT_EQ(summary_of(some, facts()).status, 3);
  some[3].verdict = "failed";
  EXPECT_EQ(summary_of(some, facts()).status, 4);
  some.resize(2);
  EXPECT_EQ(summary_of(some, facts()).status, 1);
  some.resize(1);
  EXPECT_EQ(summary_of(some, facts()).status, 0);
}

TEST(BatchSummary, AnEmptyBatchHasNoResidualAndNoFaultRate) {
  const Json all = Json::parse(to_json(summary_of({}, facts())))["all"];
  EXPECT_TRUE(all["median_residual"].is_null());
  EXPECT_TRUE(all["faults_per_hour"].is_null());
}

TEST(BatchSummary, TheJsonHasNullForTheJointOfAFaultWithoutJoint) {
  const Json json = Json::parse(to_json(summary_of(rows(), facts())));
  EXPECT_EQ(json["schema"], "faultline/batch-summary/2");
  EXPECT_EQ(json["shard"], 1);
  EXPECT_EQ(json["faults"][0], (Json{{"kind", "locked"}, {"joint", 2}, {"count", 2}}));
  EXPECT_TRUE(json["faults"][1]["joint"].is_null());
  EXPECT_DOUBLE_EQ(json["all"]["faults_per_hour"].get<double>(), 2.0);
}

TEST(BatchSummary, TheTextNamesCountsAndKinds) {
  EXPECT_EQ(to_text(summary_of(rows(), facts())),
            "5 logs: 1 healthy, 2 faulty, 1 inconclusive, 1 unusable\n"
            "       2  locked, joint 2\n"
            "       1  unknown\n"
            "  not diagnosed: b/4.csv: \n");
}

TEST(BatchFacts, AreReadBackFromTheirFileAndDistinguishOtherSettings) {
  const TemporaryFolder folder;
  const BatchFacts read = read_facts(folder.write("finished.json", facts_to_json(facts())));
  EXPECT_EQ(facts_to_json(read), facts_to_json(facts()));
  BatchFacts other = facts();
  other.shard = 0;
  EXPECT_EQ(settings_of(read), settings_of(other)) << "shards of one batch have the same settings";
  other.models[0].cases_sha256 = "cc";
  EXPECT_NE(settings_of(read), settings_of(other));
  other = facts();
  other.models.push_back({"scara", "dd", "ee"});
  EXPECT_NE(settings_of(read), settings_of(other)) << "another list of models is another batch";
  EXPECT_EQ(settings_of(read, read.models[0]), settings_of(other, other.models[0]))
      << "but the logs of the first model are not done again";
  EXPECT_EQ(facts_to_json(read_facts(folder.write("two.json", facts_to_json(other)))), facts_to_json(other));
  EXPECT_THROW(read_facts(folder.write("cut.json", facts_to_json(facts()).substr(0, 40))), Error);
}

TEST(BatchFacts, OfAnotherSchemaAreRefusedWithAdvice) {
  const TemporaryFolder folder;
  std::string text = facts_to_json(facts());
  text.replace(text.find("faultline/batch/2"), 17, "faultline/batch/1");
  try {
    read_facts(folder.write("finished.json", text));
    FAIL() << "they were read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_NE(error.message().find("another schema"), std::string::npos) << error.message();
    EXPECT_NE(error.message().find("run the batch again"), std::string::npos) << error.message();
  }
}

}  // namespace
}  // namespace faultline
