// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/filter_detectors.hpp"

#include "lib/reproduce/runs/criterion_sweep.hpp"
#include "lib/reproduce/runs/free_joint_filter.hpp"
#include "lib/reproduce/runs/product_detector.hpp"

namespace faultline {
namespace {

// Nats. At 73 ms a sample of a clear fault adds several, so that a coarse grid costs little.
const std::vector<double> kThresholds = {7, 10, 14, 20, 28, 40, 56, 80, 110, 160, 220};
constexpr double kName_s = 0.6;

std::vector<AlarmScore> scores(const FilteredRobot& robot, std::span<const ExperimentRun> runs,
                               const std::vector<double>& thresholds) {
  std::vector<AlarmScore> scores(thresholds.size());
  for (const ExperimentRun& run : runs) {
    const auto alarms = free_joint_alarms(robot, run.log, {thresholds, kName_s});
    for (std::size_t i = 0; i < alarms.size(); ++i) scores[i].add(run, alarms[i]);
  }
  return scores;
}

}  // namespace

DetectorResult watch_with_filters(const std::string& detector, const FilteredRobot& robot,
                                  std::span<const ExperimentRun> tuning,
                                  std::span<const ExperimentRun> test) {
  const double threshold = kThresholds[choose_setting(scores(robot, tuning, kThresholds))];
  return {detector, decision_name::kLogOdds, threshold, scores(robot, test, {threshold}).front()};
}

std::vector<DetectorResult> watch_with_product(const Learned& learned, std::span<const ExperimentRun> test) {
  const double threshold = learned.model.explain.limits.of(FaultKind::free_swinging);
  std::vector<DetectorResult> results;
  for (const char* name : {detector_name::kBankMlp, detector_name::kBankRbfn, detector_name::kBankCases})
    results.push_back({name, decision_name::kBank, threshold, {}});
  for (const ExperimentRun& run : test) {
    const ProductAlarms alarms = product_alarms(learned, run.log);
    results[0].score.add(run, alarms.mlp);
    results[1].score.add(run, alarms.rbfn);
    results[2].score.add(run, alarms.cases);
  }
  return results;
}

std::vector<ExperimentRun> some_of(std::span<const ExperimentRun> runs, int faulty, double fault_free_h) {
  std::vector<ExperimentRun> some;
  double hours = 0.0;
  for (const ExperimentRun& run : runs) {
    if (run.faulty() ? faulty-- <= 0 : hours > fault_free_h - 1e-3) continue;
    if (!run.faulty()) hours += run.log.time.back() / 3600.0;
    some.push_back(run);
  }
  return some;
}

}  // namespace faultline
