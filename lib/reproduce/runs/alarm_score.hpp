// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lib/reproduce/protocol/protocol.hpp"

namespace faultline {

/// A run to be watched, with its truth.
struct ExperimentRun {
  Log log;
  FaultLabel fault;  ///< none, or a free-swinging joint
  double onset_s = std::numeric_limits<double>::infinity();

  bool faulty() const { return fault.kind != FaultKind::none; }
};

struct RunSet {
  int faulty = 300;            ///< runs, joints 1, 2, 3 in turn
  double fault_free_h = 10.0;  ///< besides
  double hour_s = 3600.0;      ///< length of a fault-free run; the last one is what is left
  double earliest_onset_s = 2.0;
  double latest_onset_s = 20.0;  ///< the onset is uniform in between
  double after_onset_s = 6.0;    ///< the run goes on for this long, unless the freed robot runs away
};

/// Without noise: the faulty runs, then the fault-free ones.
std::vector<ExperimentRun> monitored_runs(const Experiment& experiment, const RunSet& set, SeedUse use);
/// The same runs as measured with noise of `sigma` half ranges; `experiment` and `use` as when they were
/// made.
std::vector<ExperimentRun> with_noise(std::vector<ExperimentRun> runs, const Experiment& experiment,
                                      double sigma, SeedUse use);

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

/// A difference with its 95 % interval.
struct PairedDifference {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// Of a value that each run has under two detectors: mean of `ours` minus mean of `theirs`, the interval by
/// drawing runs with replacement (paired bootstrap). Equal lengths; NaN for no runs.
PairedDifference paired_difference(std::span<const double> ours, std::span<const double> theirs,
                                   std::uint64_t seed = 1, int draws = 2000);

/// Per run: onset to alarm, `missed_s` where there was none.
std::vector<double> delays_of(const AlarmScore& score, double missed_s);
/// Per run: 1 where the fault was found and its joint (or kind and joint) named right.
std::vector<double> joints_right(const AlarmScore& score);
std::vector<double> kinds_right(const AlarmScore& score);

}  // namespace faultline
