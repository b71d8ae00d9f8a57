// SPDX-License-Identifier: MIT
// `diagnose --at` and `diagnose --stop`: the question about a stop.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/work/stop_moment.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/robot/robot.hpp"
#include "tests/support/json_schema.hpp"
#include "tests/support/mcap_messages.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kRoot = FAULTLINE_SOURCE_DIR;
constexpr double kOnset_s = 7.91;  // of torque_loss_1.csv, by labels.csv
constexpr double kPeriod_s = 0.073;

class StopCommand : public testing::Test {
 protected:
  StopCommand() {
    for (const auto& entry : fs::directory_iterator(kRoot + "/sample_logs/golden")) {
      const std::string name = entry.path().filename().string();
      if (name.rfind("model-", 0) == 0) fs::copy_file(entry.path(), model_);
      if (name.rfind("cases-", 0) == 0) fs::copy_file(entry.path(), model_ + ".cases.db");
    }
  }

  ProgramRun diagnose(const std::string& log, std::vector<std::string> more) const {
    more.insert(more.begin(), {"diagnose", log, "--model", model_});
    return run_program(more);
  }
  json stop_of(const std::string& log, std::vector<std::string> more) const {
    more.insert(more.end(), {"--json", json_});
    diagnose(log, std::move(more));
    return json::parse(read_file(json_)).value("stop", json());
  }
  /// The log with a further column; `cell` gives its text at a time.
  std::string with_column(const std::string& name, const std::function<std::string(double)>& cell) const {
    std::istringstream lines(read_file(log_));
    std::string text, line;
    for (bool header = true; std::getline(lines, line); header = false)
      text += line + "," + (header ? name : cell(std::stod(line))) + "\n";
    const std::string path = folder_.file("flagged.csv");
    write_file(path, text);
    return path;
  }

  TemporaryFolder folder_;
  const std::string model_ = folder_.file("bench.model");
  const std::string json_ = folder_.file("out.json");
  const std::string log_ = kRoot + "/sample_logs/bench/torque_loss_1.csv";
};

TEST_F(StopCommand, TheFirstSignLiesNearTheTrueOnset) {
  const json stop = stop_of(log_, {"--at", "9.5"});
  EXPECT_NEAR(stop.at("first_sign").at("time_s").get<double>(), kOnset_s, 3.0 * kPeriod_s);
  EXPECT_EQ(stop.at("first_sign").at("joint"), 1);
  EXPECT_EQ(stop.at("first_sign").at("kind"), "torque_loss");
  EXPECT_EQ(stop.at("findings").at(0).at("kind"), "torque_loss");
  EXPECT_EQ(stop.at("column"), json());
}

TEST_F(StopCommand, AFlagColumnGivesTheMoment) {
  const std::vector<std::pair<std::string, std::string>> flags = {
      {"0", "1"}, {"false", "true"}, {"RUN", "EMERGENCY STOP"}, {"", "trip"}};
  for (const auto& [before, after] : flags) {
    const std::string log = with_column("estop", [&](double t) { return t < 9.5 ? before : after; });
    const json stop = stop_of(log, {"--stop", "estop"});
    EXPECT_NEAR(stop.at("time_s").get<double>(), 9.5, kPeriod_s) << after;
    EXPECT_EQ(stop.at("column"), "estop");
  }
}

TEST_F(StopCommand, AFlagThatFallsIsNoStop) {
  const std::string log = with_column("ready", [](double t) { return t < 9.5 ? "1" : "0"; });
  const ProgramRun run = diagnose(log, {"--stop", "ready"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("never rises from 0"), std::string::npos) << run.err;
}

TEST_F(StopCommand, ARobotFileMayNameTheColumn) {
  const std::string log = with_column("estop", [](double t) { return t < 9.5 ? "0" : "1"; });
  Robot robot = preset_robot("RRP");
  robot.log.columns["stop"].name = "estop";
  const auto asked = stop_question(stop_log(log, {}, {}), robot, "", "");
  ASSERT_TRUE(asked);
  EXPECT_NEAR(asked->time_s, 9.5, kPeriod_s);
  EXPECT_EQ(asked->column, "estop");
  EXPECT_FALSE(stop_question(stop_log(log_, {}, {}), robot, "", ""))
      << "a log without the column is not asked about";
  EXPECT_EQ(stop_question(stop_log(log, {}, {}), robot, "3.5", "")->time_s, 3.5);
}

TEST_F(StopCommand, AMissingColumnIsNamedWithTheOthers) {
  const ProgramRun run = diagnose(log_, {"--stop", "estop"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("has no column \"estop\""), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("tau3"), std::string::npos) << run.err;
}

TEST_F(StopCommand, AMomentOutsideIsRefusedWithTheRange) {
  const ProgramRun run = diagnose(log_, {"--at", "90"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("outside of the log, which has rows from 0.000 s to 19.9"), std::string::npos)
      << run.err;
}

TEST_F(StopCommand, AMomentThatIsNoTimeIsRefused) {
  for (const char* text : {"soon", "nan", "9.5 s", "2026-11-24"}) {
    const ProgramRun run = diagnose(log_, {"--at", text});
    EXPECT_EQ(run.status, 2) << text;
    EXPECT_NE(run.err.find("is no moment"), std::string::npos) << run.err;
  }
}

TEST_F(StopCommand, AnAbsoluteTimeFindsTheRowOfAnAbsoluteLog) {
  std::istringstream lines(read_file(log_));
  std::string text, line;
  for (bool header = true; std::getline(lines, line); header = false) {
    const std::size_t comma = line.find(',');
    // 1795508130 is 2026-11-24T08:15:30Z.
    const std::string time = header ? "t" : std::to_string(1795508130.0 + std::stod(line));
    text += time + line.substr(comma) + "\n";
  }
  const std::string log = folder_.file("absolute.csv");
  write_file(log, text);
  const json stop = stop_of(log, {"--at", "2026-11-24T08:15:39.5Z"});
  EXPECT_NEAR(stop.at("time_s").get<double>(), 1795508139.5, 1e-3);
  EXPECT_NEAR(stop.at("first_sign").at("time_s").get<double>(), 1795508130.0 + kOnset_s, 3.0 * kPeriod_s);
}

TEST_F(StopCommand, EveryReportHasTheAnswer) {
  const std::string html = folder_.file("a.html"), md = folder_.file("a.md");
  const ProgramRun run = diagnose(log_, {"--at", "9.5", "--html", html, "--md", md});
  EXPECT_NE(run.out.find("At the stop, 9.500 s"), std::string::npos) << run.out;
  EXPECT_NE(read_file(html).find("<h2 id=\"stop\">At the stop, 9.500 s</h2>"), std::string::npos);
  EXPECT_NE(read_file(html).find("[9.5,\"stop\"]"), std::string::npos);
  EXPECT_NE(read_file(md).find("### At the stop, 9.500 s"), std::string::npos);
}

TEST_F(StopCommand, TheRecordingMarksTheStop) {
  const std::string out = folder_.file("out.mcap");
  diagnose(log_, {"--at", "9.5", "--mcap", out});
  bool is_marked = false;
  const RecordedFile file = read_mcap(out);
  for (const RecordedMessage& message : file.messages.at("/faultline/diagnosis"))
    is_marked = is_marked || message.bytes.find("stop") != std::string::npos;
  EXPECT_TRUE(is_marked);
}

TEST_F(StopCommand, TheAnswerFollowsTheSchema) {
  stop_of(log_, {"--at", "9.5"});
  EXPECT_FOLLOWS_SCHEMA({"diagnosis-1", json_});
}

TEST_F(StopCommand, WithoutAQuestionThereIsNoAnswer) { EXPECT_EQ(stop_of(log_, {}), json()); }

}  // namespace
}  // namespace faultline
