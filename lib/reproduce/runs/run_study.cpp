// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/run_study.hpp"

#include <mutex>

#include "lib/core/parallel.hpp"
#include "lib/reproduce/runs/run_tables.hpp"

namespace faultline {
namespace {

std::vector<ControllerResults> run_all(const ReproduceOptions& options, const Progress& progress) {
  std::vector<ControllerResults> all;
  for (const ControllerVariant controller : kControllerVariants)
    all.push_back({controller, std::vector<std::vector<ConditionResult>>(options.seeds)});
  const int items = static_cast<int>(all.size()) * options.seeds;
  std::mutex reporting;
  int done = 0;
  parallel_for(items, options.threads, [&](int item) {
    ControllerResults& results = all[item / options.seeds];  // held, the longest, first
    const int i = item % options.seeds;
    results.by_seed[i] = run_conditions(results.controller, run_plan(results.controller, options.quick),
                                        options.seed + static_cast<std::uint64_t>(i));
    const std::lock_guard lock(reporting);
    if (progress) progress("watching runs", static_cast<double>(++done) / items);
  });
  return all;
}

}  // namespace

StudyResult run_study(const ReproduceOptions& options, const Progress& progress) {
  options.check();
  const std::vector<ControllerResults> all = run_all(options, progress);
  StudyResult study;
  for (const ControllerResults& results : all) study.tables.push_back(detector_table(results));
  for (const ControllerResults& results : all) study.tables.push_back(comparison_table(results));
  for (const ControllerResults& results : all)
    for (int s = 0; s < static_cast<int>(results.by_seed[0].size()); ++s)
      study.tables.push_back(trade_off_table(results, s));
  study.goals = run_goals(all.front());
  return study;
}

}  // namespace faultline
