// SPDX-License-Identifier: MIT
#include "tests/reproduce/quick_reproduction.hpp"

#include <limits>
#include <string>

#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"

namespace faultline::testing {
namespace {

using Json = nlohmann::json;

Measured measured_of(const Json& json) {
  Measured measured;
  for (const Json& value : json.at("by_seed"))
    measured.by_seed.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                               : value.get<double>());
  return measured;
}

ResultRow row_of(const Json& json) {
  ResultRow row{json.at("labels"), {}};
  for (const Json& figure : json.at("figures"))
    row.figures.push_back(figure.is_null() ? std::nullopt : std::optional(measured_of(figure)));
  return row;
}

ResultTable table_of(const Json& json) {
  ResultTable table{json.at("id"), json.at("title"), json.at("text"), json.at("labels"), {}, {}};
  for (const Json& column : json.at("figures"))
    table.figure_columns.push_back({column.at("name"), column.at("unit")});
  for (const Json& row : json.at("rows")) table.rows.push_back(row_of(row));
  return table;
}

Goal goal_of(const Json& json) {
  return {.what = json.at("what"),
          .paper = json.at("paper"),
          .study = json.at("study"),
          .bound = json.at("bound"),
          .at_most = json.at("at_most"),
          .measured = measured_of(json.at("measured")),
          .unit = json.at("unit"),
          .note = json.at("note")};
}

}  // namespace

std::string QuickReproduction::summary;
nlohmann::json QuickReproduction::index;
StudyResult QuickReproduction::generator, QuickReproduction::classifier, QuickReproduction::runs;
std::unique_ptr<TemporaryFolder> QuickReproduction::folder_;

void QuickReproduction::SetUpTestSuite() {
  folder_ = std::make_unique<TemporaryFolder>();
  const ProgramRun run = run_program({"reproduce", "--quick", "-o", out().string()});
  ASSERT_EQ(run.status, 0) << run.err;
  summary = run.out;
  index = Json::parse(read_file((out() / "index.json").string()));
  for (const Json& json : index.at("tables")) {
    ResultTable table = table_of(json);
    StudyResult& study = table.id.starts_with("generator_") ? generator
                         : table.id.starts_with("table_")   ? classifier
                                                            : runs;
    study.tables.push_back(std::move(table));
  }
  for (const Json& json : index.at("goals")) {
    Goal goal = goal_of(json);
    StudyResult& study = goal.what.starts_with("generator ")                 ? generator
                         : goal.what.find("classifier") != std::string::npos ? classifier
                                                                             : runs;
    study.goals.push_back(std::move(goal));
  }
}

void QuickReproduction::TearDownTestSuite() { folder_.reset(); }

}  // namespace faultline::testing
