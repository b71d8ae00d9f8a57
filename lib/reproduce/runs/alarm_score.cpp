// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/alarm_score.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

double share_of(const std::vector<RunOutcome>& outcomes, bool RunOutcome::*what, double of) {
  if (of <= 0.0) return std::numeric_limits<double>::quiet_NaN();
  const auto count = std::count_if(outcomes.begin(), outcomes.end(), [&](const auto& o) { return o.*what; });
  return static_cast<double>(count) / of;
}

}  // namespace

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

}  // namespace faultline
