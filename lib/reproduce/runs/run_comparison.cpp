// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lib/reproduce/runs/paired_bootstrap.hpp"
#include "lib/reproduce/runs/run_tables.hpp"
#include "lib/reproduce/runs/run_texts.hpp"

namespace faultline {
namespace {

using namespace detector_name;
using namespace decision_name;

constexpr double kMissed_s = 6.0;  // as long as a run is watched after the onset

/// One detector's score with the runs of all seeds together.
AlarmScore pooled(const ControllerResults& results, std::size_t sigma, const char* detector,
                  const char* decision) {
  AlarmScore score;
  for (const auto& seed : results.by_seed)
    if (const DetectorResult* found = find(seed[sigma], detector, decision)) score.add(found->score);
  return score;
}

/// What is compared with what.
struct Pair {
  const char* ours;
  const char* theirs;
  const char* decision;
};
constexpr Pair kPairs[] = {
    {kBestCases, kBestMlp, kLogOdds},          {kBestCases, kBestRbfn, kLogOdds},
    {kBestCases, kBestAverage, kLogOdds},      {kBestCases, kBestMlp, kConsecutive},
    {kBestCases, kBestRbfn, kConsecutive},     {kBestCases, kBestAverage, kConsecutive},
    {kProductCases, kProductMlp, kRegression}, {kProductCases, kProductRbfn, kRegression}};

void add(ResultRow& row, const PairedDifference& difference) {
  for (const double value : {difference.value, difference.low, difference.high})
    row.figures.emplace_back(Measured{{value}});
}

ResultRow row_of(const Pair& pair, double sigma, const AlarmScore& ours, const AlarmScore& theirs) {
  ResultRow row{{fmt::format("{:g}", sigma), pair.ours, pair.theirs, pair.decision}, {}};
  add(row, paired_difference(delays_of(ours, kMissed_s), delays_of(theirs, kMissed_s)));
  add(row, paired_difference(joints_right(ours), joints_right(theirs)));
  add(row, paired_difference(kinds_right(ours), kinds_right(theirs)));
  row.figures.emplace_back(Measured{{static_cast<double>(ours.false_alarms)}});
  row.figures.emplace_back(Measured{{static_cast<double>(theirs.false_alarms)}});
  row.figures.emplace_back(Measured{{ours.fault_free_h}});
  return row;
}

}  // namespace

PairedDifference delay_difference(const ControllerResults& results, std::size_t sigma, const char* theirs) {
  return paired_difference(delays_of(pooled(results, sigma, kBestCases, kLogOdds), kMissed_s),
                           delays_of(pooled(results, sigma, theirs, kLogOdds), kMissed_s));
}

ResultTable comparison_table(const ControllerResults& results) {
  const std::string name = to_string(results.controller);
  ResultTable table{"dual_" + name,
                    "Does the case-based decision on two networks pay? " + name,
                    run_texts::comparison(),
                    {"noise", "both and cases", "against", "decision"},
                    {},
                    {}};
  for (const auto& [what, unit, style] : {std::tuple("mean delay", "s", FigureStyle::decimal),
                                          std::tuple("joint right", "", FigureStyle::percent),
                                          std::tuple("joint and kind right", "", FigureStyle::percent)}) {
    table.figure_columns.push_back({what, unit, style});
    table.figure_columns.push_back({"from", unit, style});
    table.figure_columns.push_back({"to", unit, style});
  }
  table.figure_columns.push_back({"false alarms", "", FigureStyle::decimal});
  table.figure_columns.push_back({"those of the other", "", FigureStyle::decimal});
  table.figure_columns.push_back({"fault-free", "h", FigureStyle::decimal});
  for (std::size_t s = 0; s < results.by_seed[0].size(); ++s)
    for (const Pair& pair : kPairs) {
      const AlarmScore ours = pooled(results, s, pair.ours, pair.decision);
      if (!ours.outcomes.empty())
        table.rows.push_back(
            row_of(pair, results.by_seed[0][s].sigma, ours, pooled(results, s, pair.theirs, pair.decision)));
    }
  return table;
}

}  // namespace faultline
