// SPDX-License-Identifier: MIT
#include "lib/history/robot_history.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"

namespace faultline {
namespace {

HistoryRecord day(const std::string& robot, int number, double friction, const std::string& model = "m") {
  HistoryRecord made;
  made.robot = robot;
  made.model_sha256 = sha256_hex(model);
  made.log = "runs/" + std::to_string(number) + ".csv";
  made.log_sha256 = sha256_hex(robot + made.log);
  made.verdict = "healthy";
  made.start_s = 1'700'000'000.0 + 86400.0 * number;
  made.condition = {{"friction_1", friction, {friction - 1.0, friction + 1.0}, 30.0, "%"},
                    {"torque_gain_1", 0.0, {-9.0, 9.0}, 2.0, "%"}};
  return made;
}

/// Robot b gets more friction from day 10 on.
std::vector<HistoryRecord> two_robots() {
  std::vector<HistoryRecord> all;
  for (int i = 19; i >= 0; --i) {
    const double small = i % 2 ? 0.3 : -0.3;
    all.push_back(day("b", i, (i < 10 ? 0.0 : 15.0) + small));
    all.push_back(day("a", i, small));
  }
  return all;
}

TEST(RobotHistory, HasALineARobotWithItsChange) {
  const auto robots = robot_histories(two_robots(), {});
  ASSERT_EQ(robots.size(), 2u);
  EXPECT_EQ(robots[0].robot, "a");
  EXPECT_EQ(robots[0].logs, 20);
  EXPECT_EQ(robots[0].last_log, "runs/19.csv");
  EXPECT_TRUE(robots[0].wear.series[0].trend.changes.empty());
  ASSERT_EQ(robots[1].wear.series[0].trend.changes.size(), 1u);
  EXPECT_EQ(robots[1].wear.series[0].trend.changes[0].first, 10);
  const std::string page = history_page(robots);
  EXPECT_NE(page.find("<a href=\"#robot-2\">b</a>"), std::string::npos);
  EXPECT_NE(page.find("friction of joint 1 +15 %"), std::string::npos);
  EXPECT_NE(page.find("2023-11-24, runs/10.csv"), std::string::npos);
}

TEST(RobotHistory, LeavesOutItemsThatTheLogDoesNotDetermine) {
  const auto robots = robot_histories(two_robots(), {"a"});
  ASSERT_EQ(robots.size(), 1u);
  ASSERT_EQ(robots[0].wear.series.size(), 1u);
  EXPECT_EQ(robots[0].wear.series[0].name, "friction_1");
}

TEST(RobotHistory, ResultsOfEarlierModelsDoNotMixWithThoseOfTheCurrentOne) {
  std::vector<HistoryRecord> all = two_robots();
  for (int i = 20; i < 24; ++i) all.push_back(day("a", i, 40.0, "new model"));
  const auto robots = robot_histories(all, {"a"});
  EXPECT_EQ(robots[0].logs, 4);
  EXPECT_EQ(robots[0].of_other_models, 20);
  EXPECT_EQ(robots[0].wear.series[0].points.size(), 4u);
  EXPECT_NE(history_page(robots).find("20 results with earlier models"), std::string::npos);
}

TEST(RobotHistory, TheWorstFindingIsTheSurestOne) {
  std::vector<HistoryRecord> all = two_robots();
  all[1].findings = {{"locked", 2_joint, 1.0, 0.6}, {"collision", Joint(), 1.0, 0.95}};
  all[3].findings = {{"locked", 1_joint, 1.0, 0.7}};
  const auto robots = robot_histories(all, {"a"});
  EXPECT_EQ(worst_words(robots[0]), "collision, confidence 95 % (2023-12-03, runs/19.csv)");
  EXPECT_EQ(worst_words(robot_histories(all, {"b"})[0]), "none");
}

TEST(RobotHistory, AnUnknownRobotIsRefusedWithThoseThatAreThere) {
  try {
    robot_histories(two_robots(), {"c"});
    FAIL() << "it was found";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(error.message().find("it contains a, b"), std::string::npos);
  }
}

TEST(RobotHistory, ForeignTextIsInertOnThePageAndInJson) {
  std::vector<HistoryRecord> all = {day("<script>x", 1, 1.0)};
  all[0].log = "</table>\x1b[2J.csv";
  const auto robots = robot_histories(all, {});
  EXPECT_EQ(history_page(robots).find("<script>"), std::string::npos);
  EXPECT_EQ(history_page(robots).find("</table>\x1b"), std::string::npos);
  EXPECT_EQ(history_json(robots).find('\x1b'), std::string::npos);
}

TEST(HistoryRecord, IsReadFromADiagnosisAndDamageIsNamed) {
  const std::string hash(64, 'a');
  nlohmann::json json = {{"schema", "faultline/diagnosis/1"},
                         {"log", {{"path", "a.csv"}, {"sha256", hash}, {"start_s", 1.0}, {"end_s", nullptr}}},
                         {"model", {{"name", "bench"}, {"sha256", hash}}},
                         {"verdict", "healthy"},
                         {"faults", nlohmann::json::array()},
                         {"condition",
                          {{{"name", "friction_1"},
                            {"value", 1.5},
                            {"ci95", {1.0, 2.0}},
                            {"normal_range", 30.0},
                            {"unit", "%"}}}}};
  const HistoryRecord read = history_record(json.dump(), "a.json");
  EXPECT_EQ(read.robot, "bench");
  EXPECT_EQ(read.condition[0].ci95[1], 2.0);
  EXPECT_TRUE(std::isnan(read.end_s));
  const auto message = [](const std::string& text) {
    try {
      history_record(text, "a.json");
    } catch (const Error& error) {
      return error.message();
    }
    return std::string();
  };
  EXPECT_NE(message(json.dump().substr(0, 90)).find("no complete JSON report"), std::string::npos);
  json["log"]["sha256"] = "";
  EXPECT_NE(message(json.dump()).find("lacks its SHA-256"), std::string::npos);
  json["schema"] = "faultline/comparison/1";
  EXPECT_NE(message(json.dump()).find("is no diagnosis"), std::string::npos);
}

}  // namespace
}  // namespace faultline
