// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/diagnose/stop/stop_answer.hpp"
#include "lib/explain/balance_course.hpp"
#include "lib/log/log.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// The rows of a log up to a stop, as they are compared with health.
struct StopRows {
  Log log;  ///< ends with the last row that is not after the stop
  double stop_s = 0.0;
  double moment_s = 0.0;                  ///< length of the last moment
  double period_s = 0.0;                  ///< from row to row
  std::optional<BalanceCourse> course{};  ///< empty if the torque balance could not be judged

  double moment_start_s() const { return stop_s - moment_s; }
};

/// Nats above which the torque balance of a joint is outside of its healthy range: the limit for a fault of
/// no known kind.
double balance_limit(const ExplainModel& model);

/// Probability at most, for a healthy log with independent samples, that any joint's regenerated motion is
/// called changed in the last moment before a stop.
inline constexpr double kChanceOfSign = 0.01;

/// Returns the signals of every joint in the last moment, by joint, then in the order of StopSignal.
std::vector<StopChannel> stop_channels(const StopRows& rows, const Model& model);

/// Returns how many times its healthy spread the torque balance of each joint is in the last moment, by
/// joint; without it the regenerated velocity; NaN if neither is known.
std::vector<double> times_healthy(const std::vector<StopChannel>& channels, int joints);

}  // namespace faultline
