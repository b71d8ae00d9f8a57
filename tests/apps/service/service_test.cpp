// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>

#include "formats/log_writer.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/learn/small_robot.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/served_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Service, AReportIsTheBytesThatTheCommandWrites) {
  const ServedFolder service;
  Visitor visitor(service);
  const std::string job = visitor.diagnose("bench/locked_1.csv");
  ASSERT_EQ(job, "/jobs/1");
  const std::string page = visitor.result_of(job);
  EXPECT_TRUE(has(page, "joint 1 is locked, from 8.440 s on")) << page;
  const TemporaryFolder own;
  fs::copy_file(kServedSamples + "bench/locked_1.csv", own.file("locked_1.csv"));
  const std::string command = "cd '" + own.path().string() +
                              "' && '" FAULTLINE_PROGRAM "' diagnose locked_1.csv --model '" +
                              service.file("bench.model") + "' --json r.json --html r.html --mcap r.mcap";
  ASSERT_EQ(run_command({"sh", "-c", command}).status, 1);
  EXPECT_EQ(visitor.get(job + "/report.json").body, read_file(own.file("r.json")));
  EXPECT_EQ(visitor.get(job + "/report.html").body, read_file(own.file("r.html")));
  EXPECT_EQ(visitor.get(job + "/log").body, read_file(own.file("locked_1.csv")));
  const ServiceAnswer made = visitor.post(job + "/record", {});
  ASSERT_EQ(made.status, 303);
  visitor.result_of(made.location);
  EXPECT_EQ(visitor.get(made.location + "/recording.mcap").body, read_file(own.file("r.mcap")));
}

TEST(Service, AStatementAboutAFaultBecomesACase) {
  const ServedFolder service;
  Visitor visitor(service);
  const std::string job = visitor.diagnose("bench/locked_1.csv");
  visitor.result_of(job);
  const std::size_t before = read_case_base(service.file("bench.model.cases.db")).cases().size();
  const ServiceAnswer answer = visitor.post(job + "/case", {{"fault_id", "1"},
                                                            {"kind", "collision"},
                                                            {"joint", "1"},
                                                            {"done", "moved the <box>"},
                                                            {"by", "Weber"}});
  EXPECT_EQ(answer.status, 303);
  const auto cases = read_case_base(service.file("bench.model.cases.db")).cases();
  ASSERT_EQ(cases.size(), before + 1);
  EXPECT_EQ(cases.back().label, (FaultLabel{FaultKind::collision, 1_joint}));
  EXPECT_EQ(cases.back().person, "Weber");
  const std::string page = visitor.get(job).body;
  EXPECT_TRUE(has(page, "joint 1 was hit or pushed, stated by Weber; done: moved the &lt;box&gt;")) << page;
  const ServiceAnswer wrong =
      visitor.post(job + "/case", {{"fault_id", "1"}, {"kind", "locked"}, {"joint", "9"}});
  EXPECT_EQ(wrong.status, 422);
  EXPECT_EQ(read_case_base(service.file("bench.model.cases.db")).cases().size(), before + 1);
}

/// A healthy log of a robot that is learned in a second.
SentFile small_log(const std::string& name, std::uint64_t seed) {
  const TemporaryFolder folder;
  const std::string path = folder.file(name);
  write_log(path, simulate(small_robot(), small_run(20.0), seed).log);
  return {name, read_file(path)};
}

TEST(Service, ARobotIsLearnedFromHealthyLogsAndItsSuggestedFile) {
  const ServedFolder service;
  Visitor visitor(service);
  const ServiceAnswer sent = visitor.post("/jobs", {{"key", visitor.key()}, {"kind", "suggest"}},
                                          {small_log("healthy_1.csv", 21), small_log("healthy_2.csv", 22)});
  ASSERT_EQ(sent.status, 303) << sent.body;
  const std::string suggestion = sent.location;
  EXPECT_TRUE(has(visitor.result_of(suggestion), "axes = ")) << visitor.get(suggestion).body;
  const std::string robot = robot_file_text(unknown_small_robot());
  const ServiceAnswer learned = visitor.post(
      "/jobs",
      {{"key", visitor.key()}, {"kind", "learn"}, {"of", "1"}, {"name", "cell-4"}, {"robot", robot}});
  ASSERT_EQ(learned.status, 303) << learned.body;
  const std::string page = visitor.result_of(learned.location);
  EXPECT_TRUE(has(page, "The robot is ready")) << page;
  EXPECT_TRUE(fs::exists(service.file("cell-4.model")) && fs::exists(service.file("cell-4.model.cases.db")));
  EXPECT_TRUE(has(visitor.get("/").body, "cell-4.model"));
  const ServiceAnswer again = visitor.post(
      "/jobs",
      {{"key", visitor.key()}, {"kind", "learn"}, {"of", "1"}, {"name", "cell-4"}, {"robot", robot}});
  EXPECT_EQ(again.status, 422);
}

TEST(Service, ARobotFileThatLearnRefusesIsExplained) {
  const ServedFolder service;
  Visitor visitor(service);
  visitor.post("/jobs", {{"key", visitor.key()}, {"kind", "suggest"}}, {sample_log("bench/healthy_1.csv")});
  const ServiceAnswer learned = visitor.post("/jobs", {{"key", visitor.key()},
                                                       {"kind", "learn"},
                                                       {"of", "1"},
                                                       {"name", "bad"},
                                                       {"robot", "axes = \"QQ\"\n"}});
  const std::string page = visitor.result_of(learned.location);
  EXPECT_TRUE(has(page, "axes")) << page;
  EXPECT_TRUE(has(page, "Correct the robot file"));
  EXPECT_FALSE(fs::exists(service.file("bad.model")));
}

TEST(Service, TwoRunsAreCompared) {
  const ServedFolder service;
  Visitor visitor(service);
  for (const char* log : {"bench/healthy_1.csv", "bench/healthy_2.csv"})
    visitor.result_of(visitor.diagnose(log));
  const ServiceAnswer sent = visitor.post("/jobs", {{"key", visitor.key()},
                                                    {"kind", "compare"},
                                                    {"model", "bench.model"},
                                                    {"first", "1"},
                                                    {"second", "2"}});
  ASSERT_EQ(sent.status, 303) << sent.body;
  const std::string job = sent.location;
  EXPECT_TRUE(has(visitor.result_of(job), "Open the comparison"));
  EXPECT_TRUE(has(visitor.get(job + "/comparison.html").body, "000001/logs/healthy_1.csv"));
  EXPECT_TRUE(has(visitor.get("/robots/bench.model").body, "Condition over time"));
}

TEST(Service, AnUnreadableLogFailsWithTheMessageOfTheCommand) {
  const ServedFolder service;
  Visitor visitor(service);
  const ServiceAnswer sent =
      visitor.post("/jobs", {{"key", visitor.key()}, {"kind", "diagnose"}, {"model", "bench.model"}},
                   {{"notes.csv", "this is\nno log\n"}});
  const std::string page = visitor.result_of(sent.location);
  EXPECT_TRUE(has(page, "role=\"alert\"")) << page;
  EXPECT_TRUE(has(page, "notes.csv")) << page;
}

TEST(Service, AJobThatTakesTooLongIsEnded) {
  const ServedFolder service({"--most-minutes", "0.0001"});
  Visitor visitor(service);
  EXPECT_TRUE(has(visitor.result_of(visitor.diagnose("bench/healthy_1.csv")), "longer than the limit"));
}

TEST(Service, WaitingAndRunningJobsAreCancelledAndEndedOnesDeleted) {
  const ServedFolder service({"--workers", "1"});
  Visitor visitor(service);
  std::vector<std::string> jobs;
  for (int i = 0; i < 4; ++i) jobs.push_back(visitor.diagnose("bench/locked_1.csv"));
  EXPECT_EQ(visitor.post(jobs[3] + "/delete", {}).status, 422) << "it has not ended";
  EXPECT_EQ(visitor.post(jobs[3] + "/cancel", {}).status, 303);
  EXPECT_TRUE(has(visitor.get(jobs[3]).body, "cancelled"));
  for (int i = 0; i < 3; ++i) visitor.result_of(jobs[i]);
  EXPECT_EQ(visitor.post(jobs[3] + "/delete", {}).status, 303);
  EXPECT_EQ(visitor.get(jobs[3]).status, 404);
  EXPECT_FALSE(fs::exists(service.file("serve/jobs/000004")));
  EXPECT_TRUE(fs::exists(service.file("serve/jobs/000003/report.json")));
}

TEST(Service, WhatWasAcknowledgedSurvivesKills) {
  ServedFolder service;
  Visitor visitor(service);
  std::vector<std::string> jobs;
  for (int round = 0; round < 4; ++round) {
    for (int i = 0; i < 3; ++i) jobs.push_back(visitor.diagnose("bench/locked_1.csv"));
    service.end(SIGKILL);
    service.start();
  }
  ASSERT_EQ(std::count(jobs.begin(), jobs.end(), ""), 0);
  for (const std::string& job : jobs) EXPECT_TRUE(has(visitor.result_of(job), "joint 1 is locked")) << job;
  EXPECT_EQ(visitor.diagnose("bench/locked_1.csv"), "/jobs/13")
      << "the cookie is valid and no number is used twice";
}

TEST(Service, TheLastStatementAboutAnEventCounts) {
  const ServedFolder service;
  Visitor visitor(service);
  const std::string one = visitor.diagnose("bench/locked_1.csv"),
                    same = visitor.diagnose("bench/locked_1.csv");
  for (const std::string& job : {one, same}) visitor.result_of(job);
  const auto state = [&](const std::string& job, const char* by, const std::string& joint = "1") {
    return visitor
        .post(job + "/case",
              {{"fault_id", "1"}, {"kind", "locked"}, {"joint", joint}, {"done", "x"}, {"by", by}})
        .status;
  };
  EXPECT_EQ(state(one, "Weber"), 303);
  EXPECT_EQ(state(same, "Maier"), 303);
  const std::string page = visitor.get(one).body;
  EXPECT_TRUE(has(page, "stated by Maier")) << page;
  EXPECT_FALSE(has(page, "stated by Weber"));
  EXPECT_EQ(state(one, "Weber", "two"), 422);
  EXPECT_EQ(state(one, std::string(3000, 'a').c_str()), 422);
}

TEST(Service, ADamagedReportLeavesAPageThatDeletesTheJob) {
  const ServedFolder service;
  Visitor visitor(service);
  visitor.result_of(visitor.diagnose("bench/locked_1.csv"));
  write_file(service.file("serve/jobs/000001/report.json"), "{");
  const ServiceAnswer page = visitor.get("/jobs/1");
  EXPECT_EQ(page.status, 200);
  EXPECT_TRUE(has(page.body, "Delete this job")) << page.body;
  EXPECT_EQ(visitor.get("/").status, 200);
}

TEST(Service, APortInUseIsRefused) {
  const ServedFolder service;
  const TemporaryFolder other;
  const ProgramRun run =
      run_program({"serve", other.path().string(), "--port", std::to_string(service.port())});
  EXPECT_EQ(run.status, 2);
  EXPECT_TRUE(has(run.err, "cannot be used: another program may listen there")) << run.err;
}

TEST(Service, ARangeBeyondTheEndIsRefused) {
  const ServedFolder service;
  Visitor visitor(service);
  visitor.result_of(visitor.diagnose("bench/locked_1.csv"));
  EXPECT_EQ(visitor.get("/jobs/1/log", {{"Range", "bytes=99999999-"}}).status, 416);
  EXPECT_EQ(visitor.get("/jobs/1/log", {{"Range", "bytes=0-9"}}).body.size(), 10u);
}

TEST(Service, ASecondServiceOnTheFolderIsRefused) {
  const ServedFolder service;
  const ProgramRun run = run_program({"serve", service.file(""), "--port", "0"});
  EXPECT_EQ(run.status, 3);
  EXPECT_TRUE(has(run.err, "another faultline serve works on this folder")) << run.err;
}

}  // namespace
}  // namespace faultline
