// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/alarm_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/random.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr std::uint64_t kFaultFreeRuns = 1'000'000;  // their indices begin here
constexpr std::uint64_t kRunsNoise = 2'000'000;

ExperimentRun faulty_run(const Experiment& experiment, const RunSet& set, int index, std::uint64_t seed) {
  Random random = Random::stream(seed, 3);
  ExperimentRun run;
  run.fault = {FaultKind::free_swinging, Joint::at(index % experiment.robot.joints())};
  run.onset_s = random.uniform(set.earliest_onset_s, set.latest_onset_s);
  run.log =
      run_of_moves(experiment.robot, experiment.controller,
                   {.duration_s = run.onset_s + set.after_onset_s, .fault = {run.fault, run.onset_s}}, seed);
  return run;
}

double share_of(const std::vector<RunOutcome>& outcomes, bool RunOutcome::*what, double of) {
  if (of <= 0.0) return std::numeric_limits<double>::quiet_NaN();
  const auto count = std::count_if(outcomes.begin(), outcomes.end(), [&](const auto& o) { return o.*what; });
  return static_cast<double>(count) / of;
}

template <typename Value>
std::vector<double> of_each(const AlarmScore& score, const Value& value) {
  std::vector<double> values;
  for (const RunOutcome& outcome : score.outcomes) values.push_back(value(outcome));
  return values;
}

}  // namespace

std::vector<ExperimentRun> monitored_runs(const Experiment& experiment, const RunSet& set, SeedUse use) {
  std::vector<ExperimentRun> runs;
  for (int i = 0; i < set.faulty; ++i)
    runs.push_back(faulty_run(experiment, set, i, seed_of(experiment.seed, use, i)));
  double left_s = set.fault_free_h * 3600.0;
  for (std::uint64_t i = kFaultFreeRuns; left_s > kSamplePeriod; ++i) {
    const double duration_s = std::min(left_s, set.hour_s);
    ExperimentRun run;
    run.log =
        run_of_moves(experiment.robot, experiment.controller, {duration_s}, seed_of(experiment.seed, use, i));
    runs.push_back(std::move(run));
    left_s -= duration_s;
  }
  return runs;
}

std::vector<ExperimentRun> with_noise(std::vector<ExperimentRun> runs, const Experiment& experiment,
                                      double sigma, SeedUse use) {
  for (std::size_t i = 0; i < runs.size(); ++i)
    add_noise(runs[i].log, experiment.ranges, sigma, seed_of(experiment.seed, use, kRunsNoise + i));
  return runs;
}

void AlarmScore::add(const ExperimentRun& run, const Alarms& alarms) {
  if (run.log.rows() == 0) return;
  fault_free_h += (std::min(run.onset_s, run.log.time.back()) - run.log.time.front()) / 3600.0;
  RunOutcome outcome;
  for (const Alarm& alarm : alarms) {
    if (alarm.time_s < run.onset_s) {
      ++false_alarms;
    } else if (!outcome.detected) {
      outcome = {true, alarm.label.joint == run.fault.joint, alarm.label == run.fault,
                 alarm.time_s - run.onset_s};
    }
  }
  if (run.faulty()) outcomes.push_back(outcome);
}

void AlarmScore::add(const AlarmScore& other) {
  outcomes.insert(outcomes.end(), other.outcomes.begin(), other.outcomes.end());
  false_alarms += other.false_alarms;
  fault_free_h += other.fault_free_h;
}

double AlarmScore::detected() const {
  return share_of(outcomes, &RunOutcome::detected, static_cast<double>(outcomes.size()));
}

double AlarmScore::right_joint() const {
  return share_of(outcomes, &RunOutcome::right_joint, detected() * static_cast<double>(outcomes.size()));
}

double AlarmScore::right_kind() const {
  return share_of(outcomes, &RunOutcome::right_kind, detected() * static_cast<double>(outcomes.size()));
}

double AlarmScore::false_alarms_per_hour() const { return false_alarms / fault_free_h; }

double AlarmScore::delay_quantile(double share) const {
  std::vector<double> delays;
  for (const RunOutcome& outcome : outcomes)
    if (outcome.detected) delays.push_back(outcome.delay_s);
  return nearest_rank_quantile(std::move(delays), share);
}

PairedDifference paired_difference(std::span<const double> ours, std::span<const double> theirs,
                                   std::uint64_t seed, int draws) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t runs = ours.size();
  if (runs == 0) return {kNan, kNan, kNan};
  Random random(seed);
  const auto count = static_cast<double>(runs);
  std::vector<double> means;
  for (int d = 0; d < draws; ++d) {
    double sum = 0.0;
    for (std::size_t i = 0; i < runs; ++i) {
      const std::uint64_t k = random.below(runs);
      sum += ours[k] - theirs[k];
    }
    means.push_back(sum / count);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < runs; ++i) sum += ours[i] - theirs[i];
  return {sum / count, nearest_rank_quantile(means, 0.025), nearest_rank_quantile(means, 0.975)};
}

std::vector<double> delays_of(const AlarmScore& score, double missed_s) {
  return of_each(score, [&](const RunOutcome& o) { return o.detected ? o.delay_s : missed_s; });
}

std::vector<double> joints_right(const AlarmScore& score) {
  return of_each(score, [](const RunOutcome& o) { return o.right_joint ? 1.0 : 0.0; });
}

std::vector<double> kinds_right(const AlarmScore& score) {
  return of_each(score, [](const RunOutcome& o) { return o.right_kind ? 1.0 : 0.0; });
}

}  // namespace faultline
