// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "lib/explain/log_fit.hpp"
#include "lib/identify/days/fit_days.hpp"
#include "lib/log/memory_source.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline::testing {

inline constexpr double kExplainedPeriod_s = 0.004;

inline ClosedFormRun run_of(std::uint64_t seed) {
  return {.duration_s = 8.0,
          .period_s = kExplainedPeriod_s,
          .reach = {0.8, 0.9, 0.1},
          .q_noise = 2e-5,
          .dq_noise = 2e-3,
          .seed = seed};
}

/// A day: friction is a few per cent more or less.
inline ClosedFormScara of_day(int day) {
  ClosedFormScara out;
  for (int j = 0; j < 3; ++j) out.fc[j] *= 1.0 + 0.04 * (day % 3 - 1);
  return out;
}

inline FittedDays learned_from(const std::vector<Log>& days) {
  std::vector<MemorySource> sources;
  for (const Log& day : days) sources.emplace_back(day, "day");
  std::vector<LogSource*> logs;
  for (MemorySource& source : sources) logs.push_back(&source);
  Robot robot = preset_robot("RRP");
  robot.chain.length = {1.0, 0.8, 0.0};
  DayFitOptions options;
  options.torque_is_held = true;
  return fit_days(logs, parameter_space(robot), options);
}

/// Learned from three healthy days.
inline const BalanceModel& scara_model() {
  static const BalanceModel learned = [] {
    std::vector<Log> days;
    for (int day = 0; day < 3; ++day) days.push_back(simulate_closed_form(of_day(day), run_of(day + 1)));
    return learned_from(days).model;
  }();
  return learned;
}

inline UniformLog on_grid(Log log) {
  MemorySource source(std::move(log));
  return uniform_log(source, kExplainedPeriod_s);
}

inline LogFit fit_of(Log log) { return {on_grid(std::move(log)), scara_model()}; }

}  // namespace faultline::testing
