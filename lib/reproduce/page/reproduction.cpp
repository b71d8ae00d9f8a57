// SPDX-License-Identifier: MIT
#include "lib/reproduce/page/reproduction.hpp"

#include <mutex>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/parallel.hpp"
#include "lib/core/version.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json measured_json(const Measured& measured) {
  return {{"mean", number_or_null(measured.mean())},
          {"spread", number_or_null(measured.spread())},
          {"by_seed", numbers_or_null(measured.by_seed)}};
}

/// Labels and figures in the order of the table's columns.
Json row_json(const ResultRow& row) {
  const auto figure_json = [](const std::optional<Measured>& figure) {
    return figure ? measured_json(*figure) : Json(nullptr);
  };
  return {{"labels", row.labels}, {"figures", list_of<Json>(row.figures, figure_json)}};
}

Json column_json(const FigureColumn& column) { return {{"name", column.name}, {"unit", column.unit}}; }

Json table_json(const ResultTable& table) {
  return {{"id", table.id},
          {"title", table.title},
          {"text", table.text},
          {"labels", table.label_columns},
          {"figures", list_of<Json>(table.figure_columns, column_json)},
          {"rows", list_of<Json>(table.rows, row_json)}};
}

Json goal_json(const Goal& goal) {
  return {{"what", goal.what},
          {"paper", goal.paper},
          {"study", goal.study},
          {"bound", number_or_null(goal.bound)},
          {"at_most", goal.at_most},
          {"unit", goal.unit},
          {"measured", measured_json(goal.measured)},
          {"reached", goal.reached()},
          {"note", goal.note}};
}

Json figure_json(const Figure& figure) {
  return {{"id", figure.id},
          {"title", figure.plot.title},
          {"file", figure.id + ".svg"},
          {"caption", figure.caption}};
}

}  // namespace

void ReproduceOptions::check() const {
  if (seeds < 1 || seeds > 100)
    throw Error(ErrorCode::usage, "ReproduceOptions.seeds",
                "is " + std::to_string(seeds) + ", must be from 1 to 100");
  if (threads < 0)
    throw Error(ErrorCode::usage, "ReproduceOptions.threads",
                "is " + std::to_string(threads) + ", must not be negative");
}

void parallel_steps(const std::string& what, int count, int threads, const Progress& progress,
                    const std::function<void(int)>& work) {
  std::mutex reporting;
  int done = 0;
  parallel_for(count, threads, [&](int i) {
    work(i);
    const std::lock_guard lock(reporting);
    if (progress) progress(what, static_cast<double>(++done) / count);
  });
}

std::string reproduction_json(const Reproduction& reproduction) {
  Json json{{"schema", "faultline/reproduction/1"}, {"program", {{"version", program_version()}}}};
  json["options"] = {{"seeds", reproduction.options.seeds},
                     {"seed", reproduction.options.seed},
                     {"quick", reproduction.options.quick}};
  json["figures"] = list_of<Json>(reproduction.figures, figure_json);
  json["tables"] = list_of<Json>(reproduction.tables, table_json);
  json["goals"] = list_of<Json>(reproduction.goals, goal_json);
  return json.dump(1) + "\n";
}

}  // namespace faultline
