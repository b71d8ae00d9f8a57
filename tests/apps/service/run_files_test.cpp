// SPDX-License-Identifier: MIT
// Runs of several files on the pages of `faultline serve`.
#include <gtest/gtest.h>

#include <sstream>

#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/served_folder.hpp"

namespace faultline {
namespace {

constexpr const char* kFound = "joint 1 is locked, from 8.440 s on";
constexpr std::size_t kPositions = 7;  // columns of time, positions and velocities; torques follow

std::string locked_run() { return read_file(kServedSamples + "bench/locked_1.csv"); }

/// The log in two files: time with positions and velocities, and the torques in the same rows.
std::vector<SentFile> columns_apart() {
  std::string motion, torque;
  std::istringstream rows(locked_run());
  for (std::string row; std::getline(rows, row);) {
    std::size_t comma = 0;
    for (std::size_t k = 0; k < kPositions; ++k) comma = row.find(',', comma) + 1;
    motion += row.substr(0, comma - 1) + "\n";
    torque += row.substr(0, row.find(',') + 1) + row.substr(comma) + "\n";
  }
  return {{"motion.csv", motion}, {"torque.csv", torque}};
}

/// The log in two files, each with half the rows.
std::vector<SentFile> rows_apart() {
  const std::string all = locked_run();
  const std::size_t middle = all.find('\n', all.size() / 2) + 1;
  return {{"part1.csv", all.substr(0, middle)},
          {"part2.csv", all.substr(0, all.find('\n') + 1) + all.substr(middle)}};
}

ServiceAnswer diagnose(Visitor& visitor, const char* files, const std::vector<SentFile>& logs) {
  return visitor.post(
      "/jobs", {{"key", visitor.key()}, {"kind", "diagnose"}, {"model", "bench.model"}, {"files", files}},
      logs);
}

TEST(RunFiles, ColumnsOrRowsOfOneRunAreOneJobWithTheBytesOfTheCommand) {
  const ServedFolder service;
  Visitor visitor(service);
  const struct {
    const char *files, *option;
    std::vector<SentFile> logs;
  } runs[] = {{"columns", "--join", columns_apart()}, {"rows", "--then", rows_apart()}};
  for (const auto& run : runs) {
    const ServiceAnswer sent = diagnose(visitor, run.files, run.logs);
    ASSERT_EQ(sent.status, 303) << sent.body;
    const std::string page = visitor.result_of(sent.location);
    EXPECT_NE(page.find(kFound), std::string::npos) << page;
    EXPECT_NE(page.find(run.logs[0].name + " and 1 more file"), std::string::npos) << page;
    const TemporaryFolder own;
    for (const SentFile& log : run.logs) own.write(log.name, log.bytes);
    const std::string command = "cd '" + own.path().string() + "' && '" FAULTLINE_PROGRAM "' diagnose " +
                                run.logs[0].name + " " + run.option + " " + run.logs[1].name + " --model '" +
                                service.file("bench.model") + "' --html r.html --mcap r.mcap";
    ASSERT_EQ(run_command({"sh", "-c", command}).status, 1);
    EXPECT_EQ(visitor.get(sent.location + "/report.html").body, read_file(own.file("r.html")));
    const ServiceAnswer made = visitor.post(sent.location + "/record", {});
    visitor.result_of(made.location);
    EXPECT_EQ(visitor.get(made.location + "/recording.mcap").body, read_file(own.file("r.mcap")));
  }
  const ServiceAnswer compared = visitor.post("/jobs", {{"key", visitor.key()},
                                                        {"kind", "compare"},
                                                        {"model", "bench.model"},
                                                        {"first", "1"},
                                                        {"second", "3"}});
  EXPECT_EQ(compared.status, 422);
  EXPECT_NE(compared.body.find("is a run of several files"), std::string::npos) << compared.body;
}

TEST(RunFiles, FilesAreARunEachUnlessTheFormSaysOtherwise) {
  const ServedFolder service;
  Visitor visitor(service);
  const std::vector<SentFile> logs = {sample_log("bench/locked_1.csv"), sample_log("bench/healthy_1.csv")};
  EXPECT_EQ(diagnose(visitor, "single", logs).location, "/robots/bench.model");
  EXPECT_NE(visitor.result_of("/jobs/1").find(kFound), std::string::npos);
  EXPECT_NE(visitor.result_of("/jobs/2").find("healthy_1.csv"), std::string::npos);
}

TEST(RunFiles, ADataFileThatALogNamesGoesWithIt) {
  const ServedFolder service;
  Visitor visitor(service);
  const std::string header =
      "DIAEXTENDED\n#BEGINCHANNELHEADER\n200,q1\n210,EXPLIZIT\n211,run.r64\n213,BLOCK\n214,REAL64\n220,2\n221,1\n"
      "#ENDCHANNELHEADER\n";
  const ServiceAnswer sent =
      diagnose(visitor, "single", {{"run.r64", std::string(16, '\0')}, {"run.dat", header}});
  EXPECT_EQ(sent.location, "/jobs/1") << "two files are one job";
  EXPECT_NE(visitor.result_of("/jobs/1").find("run.dat"), std::string::npos);
}

}  // namespace
}  // namespace faultline
