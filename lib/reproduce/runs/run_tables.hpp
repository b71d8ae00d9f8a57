// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/reproduce/page/reproduction.hpp"
#include "lib/reproduce/page/result_table.hpp"
#include "lib/reproduce/protocol/protocol.hpp"
#include "lib/reproduce/runs/alarm_score.hpp"
#include "lib/reproduce/runs/run_condition.hpp"

namespace faultline {

/// The same figure of each seed's score.
template <typename Figure>
Measured of_seeds(const std::vector<const AlarmScore*>& scores, const Figure& figure) {
  Measured measured;
  for (const AlarmScore* score : scores) measured.by_seed.push_back(std::invoke(figure, *score));
  return measured;
}

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

/// The paper's figures 1 and 2 as runs: detection of a free-swinging joint at any time by single networks, by
/// both with a case-based decision, by this project's own way and by a near-optimal reference, under every
/// controller and noise reading.
StudyResult run_study(const ReproduceOptions& options, const Progress& progress = {});

/// The paper's figures 3 to 8: residual, position and velocity of joint 2, which swings freely from 4 s (MLP)
/// or 5 s (RBFN) on, with what the networks put out. Held controller, no noise, the paper's own recipe.
std::vector<Figure> fault_figures(const ReproduceOptions& options);

}  // namespace faultline
