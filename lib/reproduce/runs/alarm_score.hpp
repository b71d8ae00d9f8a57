// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "lib/reproduce/runs/monitored_runs.hpp"

namespace faultline {

/// What a detector says, and when it said so first.
struct Alarm {
  double time_s = 0.0;
  FaultLabel label;  ///< as the detector names it
};

/// The alarms of one run, in order of time.
using Alarms = std::vector<Alarm>;

/// What became of one faulty run.
struct RunOutcome {
  bool detected = false;                                      ///< an alarm at or after the onset
  bool right_joint = false;                                   ///< and the first such alarm names the joint
  bool right_kind = false;                                    ///< and joint and kind of the fault
  double delay_s = std::numeric_limits<double>::quiet_NaN();  ///< onset to that alarm
};

/// How a detector did on a set of runs. Alarms before the onset or in fault-free runs are false.
struct AlarmScore {
  std::vector<RunOutcome> outcomes;  ///< of the faulty runs
  int false_alarms = 0;
  double fault_free_h = 0.0;  ///< fault-free runs, and faulty ones up to their onset

  void add(const ExperimentRun& run, const Alarms& alarms);
  void add(const AlarmScore& other);

  double detected() const;     ///< share of the faulty runs
  double right_joint() const;  ///< share of the detected runs
  double right_kind() const;
  double false_alarms_per_hour() const;
  double delay_quantile(double share) const;  ///< s, of the detected runs; NaN for none
};

}  // namespace faultline
