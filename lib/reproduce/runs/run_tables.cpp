// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/run_tables.hpp"

#include <fmt/format.h>

#include "lib/reproduce/runs/of_seeds.hpp"
#include "lib/reproduce/runs/run_texts.hpp"

namespace faultline {
namespace {

std::vector<FigureColumn> score_columns() {
  return {{"false alarms", "per h", FigureStyle::decimal},
          {"detected", "", FigureStyle::percent},
          {"right joint", "", FigureStyle::percent},
          {"median delay", "s", FigureStyle::decimal},
          {"p90 delay", "s", FigureStyle::decimal}};
}

std::vector<std::optional<Measured>> score_figures(const std::vector<const AlarmScore*>& scores) {
  return {of_seeds(scores, [](const AlarmScore& s) { return s.false_alarms_per_hour(); }),
          of_seeds(scores, [](const AlarmScore& s) { return s.detected(); }),
          of_seeds(scores, [](const AlarmScore& s) { return s.right_joint(); }),
          of_seeds(scores, [](const AlarmScore& s) { return s.delay_quantile(0.5); }),
          of_seeds(scores, [](const AlarmScore& s) { return s.delay_quantile(0.9); })};
}

ResultRow detector_row(const ControllerResults& results, std::size_t sigma, std::size_t detector) {
  std::vector<const AlarmScore*> scores;
  Measured setting;
  AlarmScore pooled;
  for (const auto& seed : results.by_seed) {
    const DetectorResult& result = seed[sigma].detectors[detector];
    scores.push_back(&result.score);
    setting.by_seed.push_back(result.setting);
    pooled.add(result.score);
  }
  const DetectorResult& first = results.by_seed[0][sigma].detectors[detector];
  ResultRow row{{fmt::format("{:g}", results.by_seed[0][sigma].sigma), first.detector, first.decision}, {}};
  row.figures = score_figures(scores);
  row.figures.insert(row.figures.begin(), setting);
  row.figures.emplace_back(of_seeds(scores, [](const AlarmScore& s) { return s.right_kind(); }));
  row.figures.emplace_back(Measured{{static_cast<double>(pooled.outcomes.size())}});
  row.figures.emplace_back(Measured{{pooled.fault_free_h}});
  return row;
}

}  // namespace

const DetectorResult* find(const ConditionResult& condition, const std::string& detector,
                           const std::string& decision) {
  for (const DetectorResult& result : condition.detectors)
    if (result.detector == detector && result.decision == decision) return &result;
  return nullptr;
}

ResultTable detector_table(const ControllerResults& results) {
  const std::string name = to_string(results.controller);
  ResultTable table{"runs_" + name,
                    "Figures 1 and 2 as runs: a free-swinging joint at any time, " + name,
                    run_texts::detectors(results.controller),
                    {"noise", "detector", "decision"},
                    {},
                    {}};
  table.figure_columns = score_columns();
  table.figure_columns.insert(table.figure_columns.begin(), {"setting", "g or nats", FigureStyle::decimal});
  table.figure_columns.push_back({"right joint and kind", "", FigureStyle::percent});
  table.figure_columns.push_back({"faulty runs", "", FigureStyle::decimal});
  table.figure_columns.push_back({"fault-free", "h", FigureStyle::decimal});
  for (std::size_t s = 0; s < results.by_seed[0].size(); ++s)
    for (std::size_t d = 0; d < results.by_seed[0][s].detectors.size(); ++d)
      table.rows.push_back(detector_row(results, s, d));
  return table;
}

ResultTable trade_off_table(const ControllerResults& results, int sigma) {
  const std::string name = to_string(results.controller);
  const ConditionResult& first = results.by_seed[0][sigma];
  ResultTable table{
      fmt::format("trade_off_{}_{:g}", name, first.sigma),
      fmt::format("The criterion's g against false alarms and delay, {}, noise {:g} of half range", name,
                  first.sigma),
      run_texts::trade_off(),
      {"detector", "g"},
      score_columns(),
      {}};
  for (std::size_t d = 0; d < first.trade_offs.size(); ++d)
    for (std::size_t g = 0; g < first.trade_offs[d].by_g.size(); ++g) {
      std::vector<const AlarmScore*> scores;
      for (const auto& seed : results.by_seed) scores.push_back(&seed[sigma].trade_offs[d].by_g[g]);
      table.rows.push_back({{first.trade_offs[d].detector, std::to_string(g + 1)}, score_figures(scores)});
    }
  return table;
}

}  // namespace faultline
