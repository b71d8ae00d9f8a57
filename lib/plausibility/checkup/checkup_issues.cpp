// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/plausibility/checkup/checkup.hpp"

namespace faultline {
namespace {

constexpr std::int64_t kFewestStuckRows = 20;
constexpr double kRepeatedShare = 0.3;
constexpr double kMixedShare = 0.05;    // of the rows: coarse encoders have more
constexpr double kMovedSteps = 5.0;     // steps of the position, by which a joint seems to move
constexpr double kMovedAtLeast = 0.01;  // rad or m
constexpr double kMovedShare = 0.05;    // of the position's span
constexpr double kLateRows = 1.5;
constexpr double kOffVelocity = 0.1;  // relative, of a velocity's size to the position's change
constexpr double kLittleNoise = 0.1;  // of that change: more makes it larger than any velocity
constexpr double kShortestPeriod_s = 1e-5;

double step_of(const CheckupResult& checkup, Channel channel) {
  const ChannelCheckup* found = checkup.find(channel);
  return found ? found->course.step.value_or(0.0) : 0.0;
}

double span_of(const LogQuality& quality, Channel channel) {
  for (const ChannelSummary& summary : quality.channels)
    if (summary.canonical && summary.name == to_string(channel) && summary.values > 0)
      return summary.max - summary.min;
  return 0.0;
}

/// Returns how far a joint may seem to move while a healthy channel keeps its value, rad or m.
double usual_motion(const ChannelCheckup& one, const CheckupResult& checkup, const LogQuality& quality) {
  const Channel position{Quantity::q, one.channel.joint};
  const double steps = kMovedSteps * step_of(checkup, position);
  const double share = kMovedShare * span_of(quality, position);
  const double rate = one.channel.quantity == Quantity::dq
                          ? one.course.step.value_or(0.0) * one.course.while_moving.length_s
                          : 0.0;
  return std::max({steps, share, kMovedAtLeast}) + rate;
}

bool can_stick(const ChannelCheckup& one) {
  const SameValue& same = one.course.while_moving;
  const Quantity quantity = one.channel.quantity;
  if (same.rows < kFewestStuckRows) return false;
  if (quantity == Quantity::q || quantity == Quantity::dq) return true;
  const bool at_limit = same.value == one.course.at_min.value || same.value == one.course.at_max.value;
  return is_torque(quantity) && !at_limit && same.value != 0.0;
}

void judge_stuck(const CheckupResult& checkup, const LogQuality& quality, Issues& issues) {
  for (const ChannelCheckup& one : checkup.channels) {
    const SameValue& same = one.course.while_moving;
    if (!can_stick(one) || same.moved < usual_motion(one, checkup, quality)) continue;
    issues.add({"stuck_channel", to_string(one.channel), Severity::warning,
                fmt::format("stays at {:.6g} for {:.4g} s from {:.10g} s on, {} rows, while according to {} "
                            "the joint moved by {:.3g}{}",
                            same.value, same.length_s, same.start_s, same.rows,
                            one.channel.quantity == Quantity::q ? "its velocity" : "its position", same.moved,
                            one.channel.quantity == Quantity::dq ? " more or less" : ""),
                0, same.start_s});
  }
}

void judge_clock(const CheckupResult& checkup, const LogQuality& quality, Issues& issues) {
  for (const PeriodChange& change : checkup.clock_changes)
    issues.add({"clock_change", "t", Severity::warning,
                fmt::format("the sample period changes permanently at about {:.10g} s, from {:.4g} to {:.4g} "
                            "s; a model learned at one period does not hold at the other: cut the log there",
                            change.at_s, change.before_s, change.after_s),
                change.row, change.at_s});
  if (quality.time.period_s < kShortestPeriod_s)
    issues.add({"unit_implausible", "t", Severity::severe,
                fmt::format(
                    "a row every {:.3g} s is more often than robots log; if the time is in s and was treated "
                    "as a smaller unit, state the unit in the robot file: [log.columns] t = {{unit = \"s\"}}",
                    quality.time.period_s)});
}

void judge_repeated(const CheckupResult& checkup, const LogQuality& quality, Issues& issues) {
  const auto rows = static_cast<double>(std::max<std::int64_t>(quality.time.rows, 1));
  const auto is_often = [rows](const RepeatedRowCount& repeated) {
    return static_cast<double>(repeated.held) / rows >= kRepeatedShare && repeated.held >= kFewestStuckRows;
  };
  const auto& [all, positions, mixed] = checkup.repeated;
  if (is_often(all))
    issues.add({"rows_repeated", "", Severity::warning,
                fmt::format("{:.1f} % of the rows repeat the row before, at another time: the signals change "
                            "less often than they were logged, so the true rate is lower",
                            100.0 * static_cast<double>(all.held) / rows),
                all.first_row, std::nan(""), all.held});
  else if (is_often(positions) && static_cast<double>(mixed) < kMixedShare * rows &&
           checkup.joints.size() > 1)
    issues.add(
        {"positions_repeated", "", Severity::warning,
         fmt::format("{:.1f} % of the rows repeat all positions of the row before while other columns "
                     "change: positions are measured less often than they are logged; log at their rate",
                     100.0 * static_cast<double>(positions.held) / rows),
         positions.first_row, std::nan(""), positions.held});
}

/// Adds an issue if a velocity's size differs from the position's change per row, unless noise explains it.
void judge_velocity_size(const VelocityRelated& velocity, const std::string& channel, Issues& issues) {
  if (!(std::abs(velocity.rms_ratio - 1.0) > kOffVelocity && velocity.noise_share < kLittleNoise)) return;
  issues.add({"velocity_off", channel, Severity::note,
              fmt::format("is {:.2f} times as large (rms) as the position's change from row to row: one of "
                          "them is filtered, coarse, scaled or measured less often",
                          velocity.rms_ratio)});
}

void judge_joints(const CheckupResult& checkup, Issues& issues) {
  for (std::size_t j = 0; j < checkup.joints.size(); ++j) {
    const auto& [velocity, torque] = checkup.joints[j];
    const Joint joint = Joint::at(static_cast<int>(j));
    if (torque.is_against_acceleration())
      issues.add(
          {"torque_against_acceleration", to_string({Quantity::tau, joint}), Severity::warning,
           fmt::format("falls when the joint accelerates (correlation {:.2f}): the sign of torque or "
                       "position is wrong; correct it in the robot file: [log.columns] tau{} = {{sign = -1}}",
                       torque.correlation, joint)});
    judge_velocity_size(velocity, to_string({Quantity::dq, joint}), issues);
    if (velocity.delay_rows > kLateRows)
      issues.add({"velocity_late", to_string({Quantity::dq, joint}), Severity::note,
                  fmt::format("lags the change of the position by {:.1f} rows, as a filtered velocity does",
                              velocity.delay_rows)});
    if (std::abs(torque.delay_rows) > kLateRows + torque.delay_uncertainty_rows)
      issues.add({"torque_delayed", to_string({Quantity::tau, joint}), Severity::note,
                  fmt::format("is logged {:.1f} rows {} the acceleration that it causes (correlation {:.2f})",
                              std::abs(torque.delay_rows), torque.delay_rows > 0.0 ? "after" : "before",
                              torque.correlation)});
  }
}

}  // namespace

Issues checkup_issues(const CheckupResult& checkup, const LogQuality& quality) {
  Issues issues;
  judge_clock(checkup, quality, issues);
  judge_repeated(checkup, quality, issues);
  judge_stuck(checkup, quality, issues);
  judge_joints(checkup, issues);
  return issues;
}

double share_at_limits(const ChannelSummary& summary) {
  if (summary.values == 0 || summary.min == summary.max) return 0.0;
  return static_cast<double>(std::max(summary.at_min, summary.at_max)) / static_cast<double>(summary.values);
}

double completeness(const TimeAxis& time) {
  const double periods = (time.end_s - time.start_s) / time.period_s;
  if (!std::isfinite(periods)) return std::nan("");
  return std::min(static_cast<double>(time.rows) / (std::round(periods) + 1.0), 1.0);
}

}  // namespace faultline
