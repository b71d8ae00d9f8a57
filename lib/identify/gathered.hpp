// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/motion/excerpt.hpp"
#include "lib/identify/motion/log_survey.hpp"
#include "lib/identify/motion/measurements.hpp"
#include "lib/identify/weak_form/weak_windows.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Data that the passes over the logs gather.
struct Gathered {
  std::vector<LogSurvey> surveys;
  WeakSets windows;
  Measurements measurements;
  std::vector<bool> left_out;       ///< by log: its windows and excerpts are excluded
  std::vector<double> torque_gain;  ///< by joint: true torque per logged torque; empty: all 1

  void leave_out(const std::vector<int>& logs);
  /// Excludes the balances of those joints, from 1.
  void leave_out_joints(const std::vector<int>& still);
};

/// Reads every log twice; adds the properties of each to `id.logs` and its issues to `id.issues`. Throws
/// Error(input) if they give too few windows.
Gathered gather(std::span<LogSource* const> logs, double shortest_window_s, int max_windows,
                const Progress& progress, Identification& id);

/// Reads every log once more for the windows of another space; the other fields of `gathered` stay.
void gather_again(std::span<LogSource* const> logs, const ParameterSpace& space, const ExtraSetting& setting,
                  Gathered& gathered);

/// Returns the joints, from 1, whose position hardly changed in all logs: within its noise, or by less than 2
/// mrad or .2 mm.
std::vector<int> unmoved_joints(const Measurements& measurements, const ParameterSpace& space);

/// Returns excerpts of the logs with each joint's torque shifted by the samples of its delay.
std::vector<Excerpt> gather_excerpts(std::span<LogSource* const> logs, const Gathered& gathered,
                                     const std::vector<int>& shift, Excerpts excerpts);

}  // namespace faultline
