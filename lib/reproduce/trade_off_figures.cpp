// SPDX-License-Identifier: MIT
#include "lib/reproduce/trade_off_figures.hpp"

#include <algorithm>
#include <limits>
#include <string>

namespace faultline {
namespace {

constexpr const char* kPrefix = "trade_off_";

std::string panel_label(const FigureColumn& column) {
  if (column.style == FigureStyle::percent) return column.name + ", %";
  return column.unit.empty() ? column.name : column.name + ", " + column.unit;
}

/// Rows that share all labels but the last, which is g, make one curve.
std::string curve_name(const ResultRow& row) {
  std::string name;
  for (std::size_t i = 0; i + 1 < row.labels.size(); ++i) name += (i ? ", " : "") + row.labels[i];
  return name;
}

PlotPanel panel_of(const ResultTable& table, std::size_t column) {
  const FigureColumn& shown = table.figure_columns[column];
  const double factor = shown.style == FigureStyle::percent ? 100.0 : 1.0;
  PlotPanel panel{.y_label = panel_label(shown), .series = {}};
  panel.log_y = shown.unit == "per h";
  for (const ResultRow& row : table.rows) {
    const std::string name = curve_name(row);
    auto series = std::find_if(panel.series.begin(), panel.series.end(),
                               [&](const PlotSeries& s) { return s.name == name; });
    if (series == panel.series.end())
      series = panel.series.insert(series, PlotSeries{.name = name, .x = {}, .y = {}, .points = true});
    series->x.push_back(std::stod(row.labels.back()));
    series->y.push_back(row.figures[column] ? factor * row.figures[column]->mean()
                                            : std::numeric_limits<double>::quiet_NaN());
  }
  return panel;
}

Figure figure_of(const ResultTable& table) {
  Figure figure{
      table.id,
      "**" + table.title +
          ".** False alarms are on a logarithmic axis; where there were none the "
          "curve ends.",
      {.title = table.title, .x_label = "g, samples", .panels = {}, .marks = {}, .panel_height = 120}};
  for (std::size_t i = 0; i < table.figure_columns.size(); ++i)
    figure.plot.panels.push_back(panel_of(table, i));
  return figure;
}

}  // namespace

std::vector<Figure> trade_off_figures(const std::vector<ResultTable>& tables) {
  std::vector<Figure> figures;
  for (const ResultTable& table : tables)
    if (table.id.starts_with(kPrefix)) figures.push_back(figure_of(table));
  return figures;
}

}  // namespace faultline
