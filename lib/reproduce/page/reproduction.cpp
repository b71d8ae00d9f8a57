// SPDX-License-Identifier: MIT
#include "lib/reproduce/page/reproduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "lib/core/error.hpp"
#include "lib/core/json_values.hpp"
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

/// "best recipe, MLP" in its two parts.
struct Detector {
  std::string recipe, network;
};

Detector detector_of(const ResultRow& row) {
  const std::string& name = row.labels.front();
  const std::size_t comma = name.find(", ");
  if (comma == std::string::npos) return {name, name};
  return {name.substr(0, comma), name.substr(comma + 2)};
}

std::vector<std::string> recipes_of(const ResultTable& table) {
  std::vector<std::string> recipes;
  for (const ResultRow& row : table.rows) {
    const std::string recipe = detector_of(row).recipe;
    if (std::find(recipes.begin(), recipes.end(), recipe) == recipes.end()) recipes.push_back(recipe);
  }
  return recipes;
}

void add_point(PlotPanel& panel, const std::string& network, double g, double value) {
  auto series = std::find_if(panel.series.begin(), panel.series.end(),
                             [&](const PlotSeries& s) { return s.name == network; });
  if (series == panel.series.end())
    series = panel.series.insert(series, PlotSeries{.name = network, .x = {}, .y = {}});
  series->x.push_back(g);
  series->y.push_back(value);
}

PlotPanel panel_of(const ResultTable& table, const std::string& recipe, std::size_t column) {
  const FigureColumn& shown = table.figure_columns[column];
  const bool share = shown.style == FigureStyle::percent;
  const std::string unit = share ? "%" : shown.unit;
  PlotPanel panel{.y_label = unit.empty() ? shown.name : shown.name + ", " + unit, .series = {}};
  panel.log_y = shown.unit == "per h";
  if (share) panel.y_range = {{0.0, 105.0}};
  for (const ResultRow& row : table.rows) {
    const Detector detector = detector_of(row);
    if (detector.recipe != recipe) continue;
    const double value =
        row.figures[column] ? row.figures[column]->mean() : std::numeric_limits<double>::quiet_NaN();
    add_point(panel, detector.network, std::stod(row.labels.back()), share ? 100.0 * value : value);
  }
  return panel;
}

Figure figure_of(const ResultTable& table, const std::string& recipe, std::size_t number) {
  const std::string title = table.title + ": " + recipe;
  Figure figure{
      fmt::format("{}_{}", table.id, number),
      fmt::format("**{}.** {} The curve of false alarms ends where there were none.", title, table.text),
      {.title = title, .x_label = "g, samples", .panels = {}, .marks = {}, .panel_height = 110}};
  for (std::size_t i = 0; i < table.figure_columns.size(); ++i)
    figure.plot.panels.push_back(panel_of(table, recipe, i));
  return figure;
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

bool is_trade_off(const ResultTable& table) { return table.id.starts_with("trade_off_"); }

std::vector<Figure> trade_off_figures(const std::vector<ResultTable>& tables) {
  std::vector<Figure> figures;
  for (const ResultTable& table : tables) {
    if (!is_trade_off(table)) continue;
    const std::vector<std::string> recipes = recipes_of(table);
    for (std::size_t i = 0; i < recipes.size(); ++i) figures.push_back(figure_of(table, recipes[i], i + 1));
  }
  return figures;
}

}  // namespace faultline
