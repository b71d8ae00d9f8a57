// SPDX-License-Identifier: MIT
#include "lib/wear/robot_wear.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace faultline {
namespace {

constexpr double kFirstDay = 1'700'000'000.0;  // 2023-11-14

/// A log a day; friction jumps by 20 % with log 12 of 24.
std::vector<WearLog> daily_logs(bool dated) {
  std::vector<WearLog> logs;
  for (int i = 0; i < 24; ++i) {
    const double start = dated ? kFirstDay + i * 86400.0 : 0.0;
    const double small = i % 2 ? 0.3 : -0.3;
    logs.push_back({"run_" + std::to_string(100 + i) + ".csv",
                    start,
                    {{"friction_1", (i < 12 ? 0.0 : 20.0) + small, 0.5, "%"},
                     {"torque_offset_2", small / 10.0, 0.05, "N m"}}});
  }
  return logs;
}

TEST(RobotWear, ADatedChangeNamesDateLogAndSize) {
  std::vector<WearLog> logs = daily_logs(true);
  std::swap(logs[3], logs[20]);  // the order of the files is not that of the dates
  const RobotWear wear = robot_wear("bench", "aa", logs);
  EXPECT_TRUE(wear.by_date);
  ASSERT_EQ(wear.series.size(), 2u);
  const ConditionSeries& friction = wear.series[0];
  ASSERT_EQ(friction.trend.changes.size(), 1u);
  EXPECT_EQ(change_words(wear, friction, friction.trend.changes[0]).substr(0, 7), "+20 % (");
  EXPECT_NE(change_words(wear, friction, friction.trend.changes[0]).find("from 2023-11-26, run_112.csv on"),
            std::string::npos);
  EXPECT_NE(to_text(wear).find("  bench: friction of joint 1: changed by +20 %"), std::string::npos);
  EXPECT_EQ(leading_series(wear), &friction);
}

TEST(RobotWear, WithoutDatesTheOrderOfTheLogsCounts) {
  const RobotWear wear = robot_wear("bench", "aa", daily_logs(false));
  EXPECT_FALSE(wear.by_date);
  EXPECT_STREQ(wear.step(), "log");
  EXPECT_NE(trend_words(wear, wear.series[1]).find(" N m per log ("), std::string::npos);
  ASSERT_EQ(wear.series[0].trend.changes.size(), 1u);
  EXPECT_NE(to_text(wear).find("from run_112.csv on"), std::string::npos) << to_text(wear);
}

TEST(RobotWear, IsNotApplicableWithoutConditionAndSaysSo) {
  const RobotWear wear = robot_wear("bench", "aa", {{"a.csv", kFirstDay, {}}});
  EXPECT_EQ(wear.not_applicable, "no log determines an item of the condition");
  EXPECT_EQ(to_text(wear), "");
  EXPECT_NE(wear_table(wear).find("Not applicable: no log"), std::string::npos);
  EXPECT_EQ(leading_series(wear), nullptr);
}

TEST(RobotWear, FewLogsHaveNeitherTrendNorChangesAndSaySo) {
  std::vector<WearLog> logs = daily_logs(true);
  logs.resize(3);
  const RobotWear wear = robot_wear("bench", "aa", logs);
  EXPECT_EQ(trend_words(wear, wear.series[0]), "not applicable: 3 logs determine it, 4 are needed");
  EXPECT_EQ(no_change_words(wear.series[0]), "not applicable: 3 logs determine it, 6 are needed");
}

TEST(RobotWear, ItsJsonHoldsTrendChangesAndValues) {
  const auto json = to_json(robot_wear("bench", "aa", daily_logs(true)), true);
  EXPECT_EQ(json["order"], "date");
  const auto& friction = json["series"][0];
  EXPECT_EQ(friction["name"], "friction_1");
  EXPECT_EQ(friction["changes"][0]["from"]["log"], "run_112.csv");
  EXPECT_EQ(friction["trend"]["per"], "day");
  EXPECT_EQ(friction["values"].size(), 24u);
  EXPECT_FALSE(to_json(robot_wear("bench", "aa", daily_logs(true)), false)["series"][0].contains("values"));
}

TEST(RobotWear, SeriesAreSortedByNumberOfTheJoint) {
  const RobotWear wear = robot_wear(
      "arm", "aa",
      {{"a.csv", 0.0, {{"friction_10", 1, 1, "%"}, {"friction_9", 1, 1, "%"}, {"bad", 1, 0, ""}}}});
  ASSERT_EQ(wear.series.size(), 2u);
  EXPECT_EQ(wear.series[0].name, "friction_9");
  EXPECT_EQ(wear.series[1].what, "friction of joint 10");
}

TEST(RobotWear, DatesAreDaysInUtc) {
  EXPECT_EQ(date_text(1'709'251'199.0), "2024-02-29");
  EXPECT_EQ(date_text(1'709'251'200.0), "2024-03-01");
  EXPECT_EQ(date_text(12.5), "");
  EXPECT_EQ(date_text(std::nan("")), "");
}

}  // namespace
}  // namespace faultline
