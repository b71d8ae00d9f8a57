// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/monitor/unjudged_time.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/quality.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Throws Error(input) when the log has other joints than the robot of `whose`, such as "the robot file".
void check_joints(const Log& segment, const LogSource& log, const std::string& whose, int joints);
/// The same for the robot of a model.
void check_joints(const Log& segment, const LogSource& log, const Model& model);

/// Returns the number of rows with the position and, if the log has torque, the torque of every joint.
int complete_rows(const Log& log);

/// Counts what is read of a log, however it is judged.
struct LogTally {
  LogFacts facts;         ///< rows, times and whether there are velocities, so far
  UnjudgedTime unjudged;  ///< of the log with its lost rows as empty ones
  QualityState quality;   ///< gaps, missing values, implausible units and the like

  /// Counts a segment. Throws Error(input) when the log has other joints than the model's robot, or neither
  /// torque that the model can judge nor references that a tracking relation of the model needs.
  void take(const Log& segment, const LogSource& log, const Model& model);
};

/// Returns the facts of a log that was read to its end.
LogFacts log_facts(const LogSource& log, const LogTally& tally, const Model& model);

}  // namespace faultline
