// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/core/progress.hpp"
#include "lib/monitor/listen.hpp"
#include "lib/twin/twin.hpp"

namespace faultline {

/// A simulated run as the pipeline heard it.
struct HeardRun {
  FaultLabel label;
  double onset_s = 0.0;
  double length_s = 0.0;
  Heard heard;
};

/// One run of the twin for each label, heard with the model; run i has the seed stream `first_seed + i`.
std::vector<HeardRun> hear_twin_runs(const Twin& twin, const Model& model,
                                     const std::vector<FaultLabel>& labels, std::uint64_t first_seed,
                                     int threads, const Progress& progress);

/// The episode that belongs to the run's fault: the first alarm not before its onset; -1 when there is none.
int episode_of_fault(const HeardRun& run);

/// What the pipeline makes of runs that it was not trained on.
Validation validate(const std::vector<HeardRun>& faulty, const std::vector<HeardRun>& healthy,
                    const Model& model, const CaseBase& cases);

}  // namespace faultline
