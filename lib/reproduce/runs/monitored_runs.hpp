// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
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

}  // namespace faultline
