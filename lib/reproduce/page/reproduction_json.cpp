// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/version.hpp"
#include "lib/reproduce/page/reproduction.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json measured_json(const Measured& measured) {
  Json by_seed = Json::array();
  for (const double value : measured.by_seed) by_seed.push_back(number(value));
  return {{"mean", number(measured.mean())}, {"spread", number(measured.spread())}, {"by_seed", by_seed}};
}

/// Labels and figures in the order of the table's columns.
Json row_json(const ResultRow& row) {
  Json figures = Json::array();
  for (const std::optional<Measured>& figure : row.figures)
    figures.push_back(figure ? measured_json(*figure) : Json(nullptr));
  return {{"labels", row.labels}, {"figures", figures}};
}

Json table_json(const ResultTable& table) {
  Json columns = Json::array(), rows = Json::array();
  for (const FigureColumn& column : table.figure_columns)
    columns.push_back({{"name", column.name}, {"unit", column.unit}});
  for (const ResultRow& row : table.rows) rows.push_back(row_json(row));
  return {{"id", table.id},     {"title", table.title}, {"text", table.text}, {"labels", table.label_columns},
          {"figures", columns}, {"rows", rows}};
}

Json goal_json(const Goal& goal) {
  return {{"what", goal.what},
          {"paper", goal.paper},
          {"study", goal.study},
          {"bound", number(goal.bound)},
          {"at_most", goal.at_most},
          {"unit", goal.unit},
          {"measured", measured_json(goal.measured)},
          {"reached", goal.reached()},
          {"note", goal.note}};
}

}  // namespace

std::string reproduction_json(const Reproduction& reproduction) {
  Json json{{"schema", "faultline/reproduction/1"}, {"program", {{"version", program_version()}}}};
  json["options"] = {{"seeds", reproduction.options.seeds},
                     {"seed", reproduction.options.seed},
                     {"quick", reproduction.options.quick}};
  json["goals"] = json["tables"] = json["figures"] = Json::array();
  for (const Goal& goal : reproduction.goals) json["goals"].push_back(goal_json(goal));
  for (const ResultTable& table : reproduction.tables) json["tables"].push_back(table_json(table));
  for (const Figure& figure : reproduction.figures)
    json["figures"].push_back({{"id", figure.id},
                               {"title", figure.plot.title},
                               {"file", figure.id + ".svg"},
                               {"caption", figure.caption}});
  return json.dump(1) + "\n";
}

}  // namespace faultline
