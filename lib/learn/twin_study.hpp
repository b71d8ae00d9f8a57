// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/classify/sample_classifier.hpp"
#include "lib/core/progress.hpp"
#include "lib/diagnose/monitor/monitored_log.hpp"
#include "lib/explain/least_found.hpp"
#include "lib/learn/twin.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// A monitored log whose fault is known.
struct MonitoredRun {
  FaultLabel label;
  double onset_s = 0.0;
  double length_s = 0.0;  ///< time from its first to its last row
  std::string origin;     ///< as a case stores it
  MonitoredLog log;
  double size = std::numeric_limits<double>::quiet_NaN();  ///< of the fault, of a collision its impulse
};

/// Returns the model without gear springs: the twin has rigid gears, and springs of the model that its runs
/// do not have would be evidence of faults.
Model with_rigid_gears(Model model);

struct TwinStudyOptions {
  /// Judge each run at the known times of its fault (monitor_at()), in a tenth of the computing time; else as
  /// a recorded log.
  bool at_known_times = false;
  bool keep_residuals = false;   ///< of each run, for learn_sample_mode()
  std::uint64_t first_seed = 0;  ///< run i has the seed stream `first_seed + i`
  int threads = 0;               ///< 0 = one a core; changes no byte of the result
};

/// Runs of the twin, one for each label.
struct TwinStudy {
  std::vector<MonitoredRun> runs;
  std::vector<LabelledResiduals> residuals;  ///< of all rows of each run; empty without keep_residuals
};

/// Simulates one run of the twin for each label, and judges it with the model, but with rigid gears.
TwinStudy monitored_twin_runs(const Twin& twin, const Model& model, const std::vector<FaultLabel>& labels,
                              const TwinStudyOptions& options, const Progress& progress = {});

/// Returns each of the labels whose kind is in `kinds`, `count` times; all labels if `kinds` is empty.
std::vector<FaultLabel> labels_to_simulate(const std::vector<FaultLabel>& labels, int count,
                                           const std::vector<FaultKind>& kinds);

/// Returns the episode that belongs to the run's fault: the first alarm not before its onset; null if there
/// is none.
const MonitoredEpisode* episode_of_fault(const MonitoredRun& run);

struct Validated {
  Validation validation;
  std::vector<JudgedConfidence> judged;  ///< of findings in the runs with a fault, without unknown ones
};

/// Validates the pipeline on runs that it was not trained on.
Validated validate(std::span<const MonitoredRun> faulty, std::span<const MonitoredRun> healthy,
                   const Model& model, const CaseBase& cases);

/// Returns the reach of each label, in the order of the runs: the smallest size that is found in nine of ten
/// healthy logs (`by_log`: least_found() of each), and number and median delay of the simulated runs that
/// were found. An alarm before the onset does not count.
std::vector<Detectability> detectability_of(std::span<const MonitoredRun> runs,
                                            const std::vector<std::vector<LeastFound>>& by_log);

}  // namespace faultline
