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

/// What one pass over the logs gathers.
struct Gathered {
  std::vector<LogSurvey> surveys;
  WeakSets windows;
  Measurements measurements;
  std::vector<bool> left_out;       ///< by log: its windows and excerpts do not count
  std::vector<double> torque_gain;  ///< by joint: true torque of each one logged; empty: all 1

  void leave_out(const std::vector<int>& logs);
  /// The balances of those joints, from 1, do not count.
  void leave_out_joints(const std::vector<int>& still);
};

/// Reads every log twice; what is known of each goes to `id.logs`, what was wrong to `id.issues`. Throws
/// Error(input) when they give too few windows.
Gathered gather(std::span<LogSource* const> logs, double shortest_window_s, int max_windows,
                const Progress& progress, Identification& id);

/// Reads every log once more for the windows of another space; `gathered` keeps all else.
void gather_again(std::span<LogSource* const> logs, const ParameterSpace& space, const ExtraSetting& setting,
                  Gathered& gathered);

/// Joints, from 1, whose position hardly changed in all logs, against its noise or at all: less than 2 mrad
/// or .2 mm.
std::vector<int> still_joints(const Measurements& measurements, const ParameterSpace& space);

/// Excerpts of the logs with each joint's torque shifted by as many samples as it acts later.
std::vector<Excerpt> gather_excerpts(std::span<LogSource* const> logs, const Gathered& gathered,
                                     const std::vector<int>& shift, Excerpts excerpts);

}  // namespace faultline
