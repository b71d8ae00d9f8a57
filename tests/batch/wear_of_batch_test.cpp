// SPDX-License-Identifier: MIT
// Wear and twins in the summary and on the page of a batch.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lib/batch/batch_summary.hpp"
#include "lib/batch/page/index_page.hpp"

namespace faultline {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

BatchFacts facts(int models) {
  BatchFacts made;
  for (int i = 0; i < models; ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    made.models.push_back({"robot " + name, name, "cc"});
  }
  return made;
}

/// A log a day for each model; friction of the first model jumps by 20 % with log 10 of 20.
std::vector<BatchRow> rows(const BatchFacts& facts, bool dated) {
  std::vector<BatchRow> made;
  for (const ModelFacts& model : facts.models)
    for (int i = 0; i < 20; ++i) {
      BatchRow row;
      row.log = model.sha256 + "/" + std::to_string(100 + i) + ".csv";
      row.model = model.name;
      row.model_sha256 = model.sha256;
      row.verdict = "healthy";
      row.start_s = (dated ? 1.7e9 + 86400.0 * i : 0.0);
      row.end_s = row.start_s + 10.0;
      const double jump = model.sha256 == "a" && i >= 10 ? 20.0 : 0.0;
      row.condition = {{"friction_1", jump + (i % 2 ? 0.3 : -0.3), 0.5, "%"}};
      made.push_back(row);
    }
  return made;
}

TEST(WearOfBatch, TheSummaryHoldsTheChangeOfEachModel) {
  const BatchSummary summary = summary_of(rows(facts(2), true), facts(2));
  ASSERT_EQ(summary.wear.size(), 2u);
  EXPECT_TRUE(has(to_text(summary), "  robot a: friction of joint 1: changed by +20"));
  EXPECT_FALSE(has(to_text(summary), "robot b:"));
  const auto json = nlohmann::json::parse(to_json(summary));
  EXPECT_EQ(json["wear"][0]["series"][0]["changes"][0]["from"]["log"], "a/110.csv");
  EXPECT_EQ(json["wear"][1]["series"][0]["changes"].size(), 0u);
}

TEST(WearOfBatch, ThePageSaysWhetherTrendsAreByDate) {
  const auto page = [](bool dated) {
    const auto all = rows(facts(1), dated);
    return render_index_page(all, summary_of(all, facts(1)), false);
  };
  EXPECT_TRUE(has(page(true), "By the dates of the logs."));
  EXPECT_TRUE(has(page(true), "% per day ("));
  EXPECT_TRUE(has(page(false), "trends by date are not applicable"));
  EXPECT_TRUE(has(page(false), "% per log ("));
}

TEST(WearOfBatch, TwinsAreOnThePageOnlyOfSeveralModelsOrPairs) {
  const auto page = [](const BatchFacts& made) {
    const auto all = rows(made, true);
    return render_index_page(all, summary_of(all, made), false);
  };
  EXPECT_FALSE(has(page(facts(1)), "<h2>Twins</h2>"));
  EXPECT_TRUE(has(page(facts(3)), "3 robots with the same item of the condition, 4 are needed"));
  EXPECT_TRUE(has(page(facts(6)), "friction of joint 1: robot a is +20"));
  BatchFacts paired = facts(1);
  paired.twins = "1:2";
  EXPECT_TRUE(has(page(paired), "0 pairs with the same item"));
}

}  // namespace
}  // namespace faultline
