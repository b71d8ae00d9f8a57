// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/reproduce/quick_reproduction.hpp"

namespace faultline {
namespace {

using testing::QuickReproduction;

/// Column 0 is the clean test set, 1 and 2 are those with noise, 3 the runs.
double figure(const ResultTable& table, const std::string& generator, const std::string& controller,
              int column) {
  const auto row = std::find_if(table.rows.begin(), table.rows.end(), [&](const ResultRow& r) {
    return r.labels[0] == generator && r.labels[1] == controller;
  });
  if (row == table.rows.end() || !row->figures[column]) return std::nan("");
  return row->figures[column]->mean();
}

void expect_whole(const StudyResult& study) {
  for (const ResultTable& table : study.tables) {
    EXPECT_FALSE(table.text.empty()) << table.id;
    for (const ResultRow& row : table.rows) {
      EXPECT_EQ(row.labels.size(), table.label_columns.size()) << table.id;
      EXPECT_EQ(row.figures.size(), table.figure_columns.size()) << table.id;
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_TRUE(row.figures[i] && row.figures[i]->mean() >= 0.0) << table.id << " " << row.labels[0];
    }
  }
}

/// Networks as good as in the other study, trainers in its order.
void expect_orders_of_magnitude(const ResultTable& mse) {
  const double nothing = figure(mse, "x(t+dt) = x(t)", "held", 0);
  const double gradient = figure(mse, "MLP 9-49-6, back-propagation", "held", 0);
  const double second_order = figure(mse, "MLP 9-49-6, Levenberg-Marquardt", "held", 0);
  EXPECT_GT(nothing, 1e-3);
  EXPECT_LT(nothing, 4e-3);
  EXPECT_LT(gradient, 0.4 * nothing);
  EXPECT_GT(gradient, 5e-5);
  EXPECT_LT(second_order, 0.5 * gradient);
}

/// No generator beats the noise of what it is measured against.
void expect_noise_floor(const ResultTable& mse) {
  for (const ResultRow& row : mse.rows) {
    EXPECT_GT(row.figures[1]->mean(), 1.0e-4) << row.labels[0];
    EXPECT_GT(row.figures[2]->mean(), 1.0e-2) << row.labels[0];
  }
  EXPECT_NEAR(
      figure(mse, "physics, true parameters", "held", 2) / figure(mse, "physics, true parameters", "held", 1),
      100.0, 3.0);
}

/// A set-point that jumps between samples is not predicted.
void expect_runs_harder_for_pd_alone(const ResultTable& mse) {
  const std::string mlp = "MLP 9-49-6, Levenberg-Marquardt";
  EXPECT_GT(figure(mse, mlp, "pd", 3), 20.0 * figure(mse, mlp, "pd", 0));
  EXPECT_LT(figure(mse, mlp, "held", 3), 5.0 * figure(mse, mlp, "held", 0));
}

void expect_outputs_average_to_the_whole(const ResultTable& by_output, const ResultTable& mse) {
  const ResultRow& row = by_output.rows.front();
  double sum = 0.0;
  for (const auto& output : row.figures) sum += output->mean();
  EXPECT_NEAR(sum / 6.0, figure(mse, row.labels[0], row.labels[1], 0), 1e-12);
}

/// Identification mends a wrong model, and the hybrid reaches its goal.
void expect_identification_pays(const StudyResult& study) {
  const ResultTable& friction = study.tables[2];
  const double wrong = figure(friction, "physics, masses 5 % off, no friction", "fast", 0);
  const double identified = figure(friction, "physics, identified", "fast", 0);
  EXPECT_GT(wrong, 1e-2);
  EXPECT_LT(identified, 1e-3 * wrong);
  ASSERT_EQ(study.goals.size(), 3u);
  EXPECT_TRUE(study.goals[2].reached()) << study.goals[2].measured.mean();
}

TEST_F(QuickReproduction, GeneratorsShowTheEffectsOfTheFullStudy) {
  ASSERT_EQ(generator.tables.size(), 3u);
  expect_whole(generator);
  expect_orders_of_magnitude(generator.tables[0]);
  expect_noise_floor(generator.tables[0]);
  expect_runs_harder_for_pd_alone(generator.tables[0]);
  expect_outputs_average_to_the_whole(generator.tables[1], generator.tables[0]);
  expect_identification_pays(generator);
}

}  // namespace
}  // namespace faultline
