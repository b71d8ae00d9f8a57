// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "lib/explain/log_fit.hpp"
#include "lib/identify/days/fit_days.hpp"
#include "lib/log/log_source.hpp"
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

inline Robot scara_robot() {
  Robot robot = preset_robot("RRP");
  robot.chain.length = {1.0, 0.8, 0.0};
  return robot;
}

inline FittedDays learned_from(const std::vector<Log>& days, const Robot& robot = scara_robot()) {
  std::vector<MemorySource> sources;
  for (const Log& day : days) sources.emplace_back(day, "day");
  std::vector<LogSource*> logs;
  for (MemorySource& source : sources) logs.push_back(&source);
  return fit_days(logs, parameter_space(robot), TorqueTiming::held);
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

/// The log with changes of its rows from `onset_s` until `end_s`.
template <typename Change>
Log changed(Log log, double onset_s, double end_s, Change change) {
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= onset_s && log.time[k] < end_s) change(log, k);
  return log;
}

/// The log of a drive that loses a share of its torque.
inline Log with_loss(Log log, Joint joint, double share, double onset_s, double end_s = kNeverEnds) {
  return changed(std::move(log), onset_s, end_s,
                 [=](Log& l, int k) { l.tau[joint.index()][k] /= 1.0 - share; });
}

/// A loose contact: half of the torque of joint 1 is lost from 3.5 s on, but not from 5.5 to 6.5 s.
inline Log with_loss_but_for_a_second(std::uint64_t seed) {
  ClosedFormRun run = run_of(seed);
  run.duration_s = 12.0;
  return with_loss(with_loss(simulate_closed_form(of_day(0), run), 1_joint, 0.5, 3.5, 5.5), 1_joint, 0.5,
                   6.5);
}

}  // namespace faultline::testing
