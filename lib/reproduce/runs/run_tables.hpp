// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/reproduce/page/result_table.hpp"
#include "lib/reproduce/protocol/protocol.hpp"
#include "lib/reproduce/runs/paired_bootstrap.hpp"
#include "lib/reproduce/runs/run_condition.hpp"

namespace faultline {

/// The results of one controller: [seed][noise].
struct ControllerResults {
  ControllerVariant controller = ControllerVariant::held;
  std::vector<std::vector<ConditionResult>> by_seed;
};

/// Null when this condition has no such detector.
const DetectorResult* find(const ConditionResult& condition, const std::string& detector,
                           const std::string& decision);

/// Every detector under every noise: `runs_<controller>`.
ResultTable detector_table(const ControllerResults& results);
/// Each detector for g = 1 to 30 at the noise of index `sigma`: `trade_off_<controller>_<sigma>`.
ResultTable trade_off_table(const ControllerResults& results, int sigma);
/// Dual classification with cases against single networks and their average, with 95 % intervals.
ResultTable comparison_table(const ControllerResults& results);

/// Of the mean delay at the noise of index `sigma`: both networks and cases (best recipe, summed log odds)
/// minus the detector `theirs`.
PairedDifference delay_difference(const ControllerResults& results, std::size_t sigma, const char* theirs);

/// The rows on detection at any time, held, and on dual classification.
std::vector<Goal> run_goals(const ControllerResults& held);

}  // namespace faultline
