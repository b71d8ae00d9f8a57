// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lib/reproduce/runs/run_tables.hpp"

namespace faultline {
namespace {

std::vector<ControllerResults> run_all(const ReproduceOptions& options, const Progress& progress) {
  std::vector<ControllerResults> all;
  for (const ControllerVariant controller : kControllerVariants)
    all.push_back({controller, std::vector<std::vector<ConditionResult>>(options.seeds)});
  const int items = static_cast<int>(all.size()) * options.seeds;
  parallel_steps("watching runs", items, options.threads, progress, [&](int item) {
    ControllerResults& results = all[item / options.seeds];  // held, the longest, first
    const int i = item % options.seeds;
    results.by_seed[i] = run_conditions(results.controller, run_plan(results.controller, options.quick),
                                        options.seed + static_cast<std::uint64_t>(i));
  });
  return all;
}

/// A row of the issue: what one detector must reach at one noise.
struct Bounds {
  double sigma, detected, joint, median_s, p90_s;
  const char *study_detected, *study_joint, *study_alarms, *study_median, *study_p90;
};
constexpr Bounds kBounds[] = {
    {0.01, 1.0, 0.995, 0.15, 0.5, "100 %", "100 %", "0 in 3 h", "0.15 s", "0.67 s"},
    {0.1, 0.995, 0.995, 0.35, 1.0, "99 %", "100 %", "0 in 3 h", "0.44 s", "1.2 s"},
};

std::vector<const AlarmScore*> scores_of(const ControllerResults& results, double sigma, const char* detector,
                                         const char* decision) {
  std::vector<const AlarmScore*> scores;
  for (const auto& seed : results.by_seed)
    for (const ConditionResult& condition : seed) {
      const DetectorResult* found = condition.sigma == sigma ? find(condition, detector, decision) : nullptr;
      if (found) scores.push_back(&found->score);
    }
  return scores;
}

void add_row(std::vector<Goal>& goals, const Bounds& bounds, const char* detector, const char* decision,
             const std::vector<const AlarmScore*>& scores) {
  if (scores.empty()) return;
  const std::string what = fmt::format(
      "free-swinging at any time, held, noise {:g}, by {} ({}): ", bounds.sigma, detector, decision);
  double hours = 0.0;
  for (const AlarmScore* score : scores) hours += score->fault_free_h;
  goals.push_back({what + "detected", "-", bounds.study_detected, bounds.detected, false,
                   of_seeds(scores, &AlarmScore::detected), FigureStyle::percent});
  goals.push_back({what + "right joint", "-", bounds.study_joint, bounds.joint, false,
                   of_seeds(scores, &AlarmScore::right_joint), FigureStyle::percent});
  goals.push_back({what + fmt::format("false alarms in {:.1f} h", hours), "-", bounds.study_alarms, 0.0, true,
                   of_seeds(scores, &AlarmScore::false_alarms), FigureStyle::decimal});
  goals.push_back({what + "median delay", "-", bounds.study_median, bounds.median_s, true,
                   of_seeds(scores, [](const AlarmScore& s) { return s.delay_quantile(0.5); }),
                   FigureStyle::decimal, "s"});
  goals.push_back({what + "p90 delay", "-", bounds.study_p90, bounds.p90_s, true,
                   of_seeds(scores, [](const AlarmScore& s) { return s.delay_quantile(0.9); }),
                   FigureStyle::decimal, "s"});
}

constexpr const char* kWhyNotBetter =
    R"(The interval does not lie below 0. Summing log odds already removes single wrong samples, so that each
network alone has next to no false alarms, and after the onset both name the same class in {:.1f} % of the
samples: the cases have little to decide. If one network is slow, as the RBFN at noise 0.1, waiting
for it costs the faster one some of its lead; an average uses both at every sample. All of this is within some
tens of milliseconds, and a sample is 73 ms. The table dual_held has every difference.)";

/// Over the runs of all seeds, at the noise of index `sigma`; %.
double agreement_percent(const ControllerResults& results, std::size_t sigma) {
  Agreement all;
  for (const auto& seed : results.by_seed) {
    all.samples += seed[sigma].best_networks.samples;
    all.same += seed[sigma].best_networks.same;
  }
  return 100.0 * static_cast<double>(all.same) / static_cast<double>(all.samples);
}

/// Upper ends of the intervals: below zero, cases are proven to be faster.
void add_dual(std::vector<Goal>& goals, const ControllerResults& held) {
  for (std::size_t s = 0; s < held.by_seed[0].size(); ++s) {
    const double sigma = held.by_seed[0][s].sigma;
    if (sigma == 0.0) continue;
    const std::string why_not_better = fmt::format(kWhyNotBetter, agreement_percent(held, s));
    for (const char* theirs :
         {detector_name::kBestMlp, detector_name::kBestRbfn, detector_name::kBestAverage}) {
      const PairedDifference difference = delay_difference(held, s, theirs);
      goals.push_back({fmt::format("dual + cases against {}, held, noise {:g}: mean delay (summed log odds), "
                                   "difference's upper 95 % end (mean {:.3f} s)",
                                   theirs, sigma, difference.value),
                       "claimed better", "not better", 0.0, true, Measured{{difference.high}},
                       FigureStyle::decimal, "s", difference.high > 0.0 ? why_not_better : ""});
    }
  }
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

std::vector<Goal> run_goals(const ControllerResults& held) {
  std::vector<Goal> goals;
  for (const Bounds& bounds : kBounds)
    add_row(goals, bounds, detector_name::kFilters, decision_name::kLogOdds,
            scores_of(held, bounds.sigma, detector_name::kFilters, decision_name::kLogOdds));
  add_dual(goals, held);
  return goals;
}

}  // namespace faultline
