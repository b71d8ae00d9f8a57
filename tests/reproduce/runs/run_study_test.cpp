// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "lib/reproduce/runs/run_condition.hpp"
#include "tests/reproduce/quick_reproduction.hpp"

namespace faultline {
namespace {

using testing::QuickReproduction;

const ResultTable& table(const std::vector<ResultTable>& tables, const std::string& id) {
  return *std::find_if(tables.begin(), tables.end(), [&](const ResultTable& t) { return t.id == id; });
}

double figure(const ResultTable& table, const std::vector<std::string>& labels, const std::string& column) {
  const auto row = std::find_if(table.rows.begin(), table.rows.end(),
                                [&](const ResultRow& r) { return r.labels == labels; });
  const auto at = std::find_if(table.figure_columns.begin(), table.figure_columns.end(),
                               [&](const FigureColumn& c) { return c.name == column; });
  return row->figures[at - table.figure_columns.begin()]->mean();
}

TEST_F(QuickReproduction, RunsHaveATablePerControllerAndATradeOffPerNoise) {
  for (const char* id : {"runs_held", "runs_fast", "runs_pd", "dual_held", "trade_off_held_0.01",
                         "trade_off_held_0.1", "trade_off_pd_0.01"})
    EXPECT_TRUE(std::any_of(runs.tables.begin(), runs.tables.end(), [&](const ResultTable& t) {
      return t.id == id;
    })) << id;
  for (const ResultTable& t : runs.tables)
    for (const ResultRow& row : t.rows) {
      EXPECT_EQ(row.labels.size(), t.label_columns.size()) << t.id;
      EXPECT_EQ(row.figures.size(), t.figure_columns.size()) << t.id;
    }
}

TEST_F(QuickReproduction, GainsOfRunsOverThePaperHaveTheRightOrderOfMagnitude) {
  const ResultTable& held = table(runs.tables, "runs_held");
  const std::vector<std::string> paper = {"0.01", "paper's recipe, RBFN", decision_name::kConsecutive};
  const std::vector<std::string> best = {"0.01", detector_name::kBestAverage, decision_name::kLogOdds};
  const std::vector<std::string> filters = {"0.01", detector_name::kFilters, decision_name::kLogOdds};
  const std::vector<std::string> product = {"0.01", detector_name::kProductCases, decision_name::kRegression};
  EXPECT_GE(figure(held, best, "detected"), 0.9);
  EXPECT_GE(figure(held, best, "right joint"), 0.9);
  EXPECT_LT(figure(held, best, "median delay"), 0.5 * figure(held, paper, "median delay"));
  for (const auto& detector : {filters, product}) {
    EXPECT_EQ(figure(held, detector, "false alarms"), 0.0) << detector[1];
    EXPECT_GE(figure(held, detector, "detected"), 0.9) << detector[1];
    EXPECT_GE(figure(held, detector, "right joint"), 0.9) << detector[1];
    EXPECT_LT(figure(held, detector, "median delay"), 0.2) << detector[1];
  }
}

TEST_F(QuickReproduction, ALargerGHasFewerFalseAlarmsAndMoreDelay) {
  const ResultTable& trade_off = table(runs.tables, "trade_off_held_0.1");
  const std::string detector = detector_name::kBestMlp;
  EXPECT_GT(figure(trade_off, {detector, "1"}, "false alarms"),
            10.0 * figure(trade_off, {detector, "10"}, "false alarms"));
  EXPECT_LT(figure(trade_off, {detector, "1"}, "median delay"),
            figure(trade_off, {detector, "10"}, "median delay"));
}

TEST_F(QuickReproduction, RunsStateEachGoalWithItsMeasuredValue) {
  ASSERT_FALSE(runs.goals.empty());
  for (const Goal& goal : runs.goals) EXPECT_EQ(goal.measured.by_seed.size(), 1u) << goal.what;
}

}  // namespace
}  // namespace faultline
