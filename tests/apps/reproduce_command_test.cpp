// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>

#include "lib/core/atomic_file.hpp"
#include "tests/reproduce/quick_reproduction.hpp"
#include "tests/support/json_schema.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

using Json = nlohmann::json;
using testing::QuickReproduction;
namespace fs = std::filesystem;

void expect_orders_of_magnitude(const Json& goals) {
  EXPECT_GE(goals.size(), 12u);
  for (const Json& goal : goals) {
    const double measured = goal["measured"]["mean"], bound = goal["bound"];
    if (bound == 0.0)  // false alarms, and seconds that cases gain: few runs tell little
      EXPECT_LE(measured, 2.0) << goal["what"];
    else if (goal["at_most"].get<bool>())
      EXPECT_LE(measured, 10.0 * bound) << goal["what"];
    else
      EXPECT_GE(measured, 0.9 * bound) << goal["what"];
  }
}

void expect_full_table(const Json& tables, const char* id) {
  const auto table = std::find_if(tables.begin(), tables.end(), [&](const Json& t) { return t["id"] == id; });
  ASSERT_NE(table, tables.end()) << id;
  EXPECT_GT((*table)["rows"].size(), 2u) << id;
  for (const Json& row : (*table)["rows"]) {
    EXPECT_EQ(row["labels"].size(), (*table)["labels"].size()) << id;
    EXPECT_EQ(row["figures"].size(), (*table)["figures"].size()) << id;
  }
}

void expect_figures_3_to_8(const fs::path& folder, const std::string& page) {
  for (int number = 3; number <= 8; ++number) {
    const std::string file = "figure_" + std::to_string(number) + ".svg";
    EXPECT_NE(page.find("](" + file + ")"), std::string::npos) << file;
    const std::string picture = read_file((folder / file).string());
    EXPECT_NE(picture.find(">fault</text>"), std::string::npos) << file << " does not mark the onset";
    EXPECT_NE(picture.find(">time, s</text>"), std::string::npos) << file;
  }
  const std::regex shown(R"(\]\(([a-z0-9_.]+\.svg)\))");
  for (auto i = std::sregex_iterator(page.begin(), page.end(), shown); i != std::sregex_iterator(); ++i)
    EXPECT_TRUE(fs::exists(folder / (*i)[1].str())) << (*i)[1];
}

TEST_F(QuickReproduction, WritesTablesAndFiguresOfTheRightOrdersOfMagnitude) {
  EXPECT_NE(summary.find("index.md"), std::string::npos) << summary;
  expect_orders_of_magnitude(index["goals"]);
  for (const char* id :
       {"generator_mse", "table_1", "table_2", "runs_held", "runs_fast", "runs_pd", "dual_held"})
    expect_full_table(index["tables"], id);
  expect_figures_3_to_8(out(), read_file((out() / "index.md").string()));
  EXPECT_FOLLOWS_SCHEMA({"reproduction-1", (out() / "index.json").string()});
}

TEST(ReproduceCommand, BadOptionsAndUnwritableFoldersAreRefused) {
  EXPECT_EQ(run_program({"reproduce", "--seeds", "0"}).status, 2);
  TemporaryFolder folder;
  write_file((folder.path() / "file").string(), "x");
  const ProgramRun result = run_program({"reproduce", "--quick", "-o", (folder.path() / "file/in").string()});
  EXPECT_EQ(result.status, 3);
  EXPECT_NE(result.err.find("-o"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace faultline
