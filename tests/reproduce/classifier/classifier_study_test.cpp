// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lib/reproduce/classifier/classifier_bench.hpp"
#include "tests/reproduce/quick_reproduction.hpp"

namespace faultline {
namespace {

using testing::QuickReproduction;

/// Figure `column` of the row with this controller and recipe (the first such).
double figure(const ResultTable& table, const std::string& controller, const std::string& recipe,
              int column) {
  for (const ResultRow& row : table.rows)
    if (row.labels[0] == controller && row.labels[1] == recipe) return row.figures[column]->mean();
  ADD_FAILURE() << "no row " << controller << ", " << recipe;
  return NAN;
}

void expect_counts_of_the_paper(const ResultTable& table) {
  EXPECT_EQ(table.id, "table_1");
  ASSERT_EQ(table.rows.size(), 12u);
  EXPECT_EQ(table.rows[2].labels[1], "41-75");
  EXPECT_EQ(table.rows[2].figures[0]->mean(), 35.0);
  EXPECT_EQ(table.rows[2].figures[1]->mean(), 350.0);
  // A free joint 3 falls; a healthy robot is predicted well.
  EXPECT_GT(table.rows[2].figures[4]->mean(), 30.0 * table.rows[3].figures[4]->mean());
}

void expect_every_column(const ResultTable& table) {
  for (const ResultRow& row : table.rows) {
    EXPECT_EQ(row.labels.size(), table.label_columns.size());
    ASSERT_EQ(row.figures.size(), table.figure_columns.size()) << table.id << ' ' << row.labels[1];
    for (const auto& figure : row.figures)
      EXPECT_TRUE(!figure || std::isfinite(figure->mean())) << table.id << ' ' << row.labels[1];
  }
}

/// The paper's recipe has the order of magnitude of its table, and the best is far below.
void expect_orders_of_magnitude(const ResultTable& table) {
  EXPECT_EQ(table.id, "table_2");
  for (const char* controller : {"held", "fast", "pd"})
    for (const int test_1 : {1, 5}) {
      const double paper = figure(table, controller, "as in the paper", test_1);
      EXPECT_GT(paper, 3e-3) << controller;
      EXPECT_LT(paper, 1e-1) << controller;
    }
  for (const int test_1 : {1, 5})
    EXPECT_LT(figure(table, "fast", "all departures", test_1),
              0.3 * figure(table, "fast", "as in the paper", test_1));
}

void expect_nothing_far_below_the_posterior_under_held(const ResultTable& table) {
  const double floor = figure(table, "held", "posterior of the true model", 1);
  EXPECT_GT(floor, 5e-3);
  EXPECT_LT(floor, 2e-2);
  EXPECT_GT(figure(table, "held", "all departures", 1), 0.7 * floor);
}

TEST_F(QuickReproduction, ClassifiersHaveTheTablesAndTheirOrdersOfMagnitude) {
  const StudyResult& result = classifier;
  ASSERT_EQ(result.tables.size(), 3u);
  for (const ResultTable& table : result.tables) expect_every_column(table);
  expect_counts_of_the_paper(result.tables[0]);
  expect_orders_of_magnitude(result.tables[1]);
  expect_nothing_far_below_the_posterior_under_held(result.tables[1]);
  ASSERT_EQ(result.goals.size(), 8u);
  for (const Goal& goal : result.goals) {
    EXPECT_EQ(goal.measured.by_seed.size(), 1u);
    EXPECT_LT(goal.measured.mean(), 2.0 * goal.bound) << goal.what;
  }
}

TEST(ClassifierStudy, ARecipeGivesTheSameNumbersAgain) {
  const ClassifierBench bench(ControllerVariant::held, 4, 3, 9);
  const ClassifierRecipe recipe = classifier_recipes({.iterations = 20})[kBestCleanRecipe];
  const ClassifierErrors first = bench.measure(recipe), again = bench.measure(recipe);
  EXPECT_EQ(first.mlp.test, again.mlp.test);
  EXPECT_EQ(first.rbfn.training, again.rbfn.training);
}

}  // namespace
}  // namespace faultline
