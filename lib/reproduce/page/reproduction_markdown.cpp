// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lib/core/version.hpp"
#include "lib/reproduce/page/figure_text.hpp"
#include "lib/reproduce/page/paper_text.hpp"
#include "lib/reproduce/page/reproduction.hpp"
#include "lib/reproduce/page/trade_off_figures.hpp"

namespace faultline {
namespace {

std::string named(const FigureColumn& column) {
  return column.unit.empty() ? column.name : column.name + ", " + column.unit;
}

std::string table_line(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& text : cells) line += " " + text + " |";
  return line + "\n";
}

std::string rule(std::size_t labels, std::size_t figures) {
  std::string line = "|";
  for (std::size_t i = 0; i < labels; ++i) line += "---|";
  for (std::size_t i = 0; i < figures; ++i) line += "---:|";
  return line + "\n";
}

std::string table_text(const ResultTable& table) {
  std::string text = fmt::format("### {}\n\n", table.title);
  if (!table.text.empty()) text += table.text + "\n\n";
  std::vector<std::string> head = table.label_columns;
  for (const FigureColumn& column : table.figure_columns) head.push_back(named(column));
  text += table_line(head) + rule(table.label_columns.size(), table.figure_columns.size());
  for (const ResultRow& row : table.rows) {
    std::vector<std::string> cells = row.labels;
    for (std::size_t i = 0; i < row.figures.size(); ++i)
      cells.push_back(row.figures[i] ? figure_text(*row.figures[i], table.figure_columns[i].style) : "");
    text += table_line(cells);
  }
  return text + "\n";
}

std::string goals_text(const std::vector<Goal>& goals) {
  std::string text =
      table_line({"what", "paper", "independent study", "to reach", "measured", "reached"}) + rule(3, 3);
  std::string notes;
  for (const Goal& goal : goals) {
    const std::string unit = goal.unit.empty() ? "" : " " + goal.unit;
    text += table_line({goal.what, goal.paper, goal.study,
                        (goal.at_most ? "≤ " : "≥ ") + figure_text(goal.bound, goal.style) + unit,
                        figure_text(goal.measured, goal.style) + unit, goal.reached() ? "yes" : "no"});
    if (!goal.note.empty()) notes += fmt::format("- *{}*: {}\n", goal.what, goal.note);
  }
  return text + (notes.empty() ? "" : "\n" + notes) + "\n";
}

std::string picture_text(const Figure& figure) {
  return fmt::format("![{}]({}.svg)\n\n{}\n\n", figure.plot.title, figure.id, figure.caption);
}

std::string how_made(const ReproduceOptions& options) {
  return fmt::format(
      "Made by `faultline reproduce{}{}{}` of faultline {}. Figures are means over {} ± the standard "
      "deviation between them where there is one.\n\n",
      options.quick ? " --quick" : "", options.seeds != 5 ? fmt::format(" --seeds {}", options.seeds) : "",
      options.seed != 1 ? fmt::format(" --seed {}", options.seed) : "", program_version(),
      options.seeds == 1 ? "one experiment" : fmt::format("{} experiments", options.seeds));
}

}  // namespace

std::string reproduction_markdown(const Reproduction& reproduction) {
  std::string text = "# The paper, reproduced\n\n" + how_made(reproduction.options) + paper_introduction();
  text += "## What was to be reached\n\n" + goals_text(reproduction.goals);
  text += "## Tables\n\n";
  for (const ResultTable& table : reproduction.tables)
    if (!is_trade_off(table)) text += table_text(table);
  text += "## Figures\n\n";
  for (const Figure& figure : reproduction.figures) text += picture_text(figure);
  return text + paper_errata();
}

}  // namespace faultline
