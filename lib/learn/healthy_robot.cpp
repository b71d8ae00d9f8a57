// SPDX-License-Identifier: MIT
#include "lib/learn/healthy_robot.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

#include "lib/core/issue.hpp"
#include "lib/core/parallel.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/days/fit_coarse_days.hpp"
#include "lib/learn/work_pieces.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/transformed/selected_rows_source.hpp"

namespace faultline {
namespace {

constexpr double kFirst = 0.4;  // share of the work that is done after the first identification
constexpr double kFitted = 0.6, kSecond = 0.8;  // the same before and after a second identification
constexpr int kDaysOfOneLog = 3;                // pieces of a single log that count as days

/// Returns the part of the identification that a model keeps to document its quality.
Identification without_state(Identification identification) {
  identification.robot = {};
  identification.space = {};
  identification.estimate = {};
  identification.covariance = {};
  identification.logs.clear();  // the model's sources list them
  return identification;
}

/// Usual sample period of the logs.
double identified_period_s(const Identification& identification) {
  std::vector<double> periods;
  for (const IdentifiedLog& log : identification.logs) periods.push_back(log.sample_period_s);
  return periods.empty() ? 0.0 : upper_median(periods);
}

/// The beginning of a model: the identified robot and the usual sample period of its logs.
Model identified_model(const Identification& identification) {
  Model model;
  model.name = identification.robot.name;
  model.robot = identification.robot;
  model.identification = without_state(identification);
  model.sample_period_s = identified_period_s(identification);
  model.has_velocity = !identification.dq_noise.empty();
  return model;
}

/// Returns what converts the torques of logs opened with one robot to those of another robot.
TorqueConversion conversion_of(const Robot& opened_with, const Robot& robot) {
  std::vector<double> delay_s = robot.torque_delay_s, gain = robot.torque_gain;
  delay_s.resize(robot.joints(), 0.0);
  gain.resize(robot.joints(), 1.0);
  for (std::size_t j = 0; j < opened_with.torque_delay_s.size(); ++j)
    delay_s[j] -= opened_with.torque_delay_s[j];
  for (std::size_t j = 0; j < opened_with.torque_gain.size(); ++j) gain[j] /= opened_with.torque_gain[j];
  return {std::move(delay_s), std::move(gain), robot.torque_limit};
}

/// Returns the logs that were not left out, with delay and gain of torques compensated; `logs` outlive them.
std::deque<ConvertedTorqueSource> compensated_logs(std::span<LogSource* const> logs,
                                                   const TorqueConversion& conversion,
                                                   const std::vector<IdentifiedLog>& identified) {
  std::deque<ConvertedTorqueSource> out;
  for (std::size_t i = 0; i < logs.size(); ++i)
    if (!identified[i].left_out) out.emplace_back(*logs[i], conversion);
  return out;
}

/// Makes model and logs of `identification`; the logs are those that were not left out of `given`.
HealthyRobot with_identification(std::span<LogSource* const> logs, const Robot& robot,
                                 Identification identification, std::vector<IdentifiedLog> given) {
  HealthyRobot out;
  out.model = identified_model(identification);
  out.conversion = conversion_of(robot, out.model.robot);
  out.logs = compensated_logs(logs, out.conversion, given);
  out.model.motion = usual_motion(pointers(out.logs), identification.robot.chain);
  out.identification = std::move(identification);
  out.given = std::move(given);
  return out;
}

/// Returns the identification with the torque delay of the robot file: a mass that comes and goes looks like
/// a delay, so that the estimated delay is not used in the search for work pieces.
Identification as_stated(Identification identification, const Robot& robot) {
  identification.robot.torque_delay_s = robot.torque_delay_s;
  return identification;
}

bool has_doubtful_delay(const Identification& identification, const Robot& robot) {
  return identification.status != IdentificationStatus::converged &&
         identification.robot.torque_delay_s != robot.torque_delay_s;
}

FittedDays fitted_days(const HealthyRobot& robot, const std::vector<LogSource*>& days) {
  const Robot& known = robot.model.robot;
  return fit_days(days, robot.identification.space, torque_between_samples(known), known.torque_limit);
}

/// Learns the robot at a coarse rate from all logs, and without each of them in turn.
void learn_steps(HealthyRobot& robot, const std::vector<LogSource*>& days, int threads) {
  const auto count = static_cast<int>(days.size());
  std::vector<Log> copies;  // parallel jobs read the same logs
  for (LogSource* log : days) {
    log->rewind();
    copies.push_back(read_all(*log));
  }
  std::vector<RobotRows> without(days.size());
  parallel_for(count + 1, threads, [&](int left_out) {
    std::vector<std::unique_ptr<MemorySource>> own;
    std::vector<LogSource*> kept;
    for (int k = 0; k < count; ++k)
      if (k != left_out) kept.push_back(own.emplace_back(std::make_unique<MemorySource>(copies[k])).get());
    RobotRows learned = fit_coarse_days(kept, robot.model.robot, robot.identification.space,
                                        torque_between_samples(robot.model.robot));
    (left_out < count ? without[left_out] : robot.model.explain.robot) = std::move(learned);
  });
  robot.without = std::move(without);
}

Issue drive_limit_issue(Joint joint, double torque) {
  return make_issue("drive_limit", Severity::warning,
                    fmt::format("the drive of joint {} gives at most {:.3g} in these logs, whatever is "
                                "commanded: a torque beyond it is not judged",
                                joint, torque),
                    to_string({Quantity::tau, joint}));
}

void take_rows(HealthyRobot& robot, FittedDays fit) {
  for (int j = 0; j < fit.model.joints(); ++j)
    if (const double limit = fit.model.drive_limit[j]; limit > 0.0)
      robot.identification.issues.add(drive_limit_issue(Joint::at(j), limit));
  robot.model.explain.robot = std::move(fit.model);
  robot.without.clear();
  for (BalanceModel& model : fit.without) robot.without.emplace_back(std::move(model));
}

/// Returns the robot that opened the logs with the limits of the drives that a first fit found.
Robot with_drive_limits(Robot robot, const HealthyRobot& first, const BalanceModel& fit) {
  if (!robot.torque_limit.empty() || fit.drive_limit.isZero(0.0)) return robot;
  robot.torque_limit.assign(fit.drive_limit.begin(), fit.drive_limit.end());
  const std::vector<double>&now = first.model.robot.torque_gain, &before = robot.torque_gain;
  for (std::size_t j = 0; j < robot.torque_limit.size(); ++j)
    robot.torque_limit[j] *= std::abs((before.empty() ? 1.0 : before[j]) / (now.empty() ? 1.0 : now[j]));
  return robot;
}

/// Returns the logs with their torques cut to the limits of the drives.
std::deque<ConvertedTorqueSource> within_limits(std::span<LogSource* const> logs, const Robot& robot) {
  std::deque<ConvertedTorqueSource> out;
  for (LogSource* log : logs) {
    log->rewind();
    out.emplace_back(*log, TorqueConversion({}, {}, robot.torque_limit));
  }
  return out;
}

/// Returns the kept logs, restricted to their rows_without_work_piece(); none if there are no such rows.
std::deque<SelectedRowsSource> without_work_piece(std::span<LogSource* const> logs, HealthyRobot& robot,
                                                  const FittedDays& fit) {
  std::deque<SelectedRowsSource> out;
  if (robot.days.size() != robot.logs.size()) return out;
  const auto ranges = rows_without_work_piece(robot.days, fit);
  if (ranges.empty()) return out;
  std::size_t next = 0;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (robot.given[i].left_out) continue;
    if (const std::vector<RowRange>& rows = ranges[next++]; !rows.empty()) {
      logs[i]->rewind();
      out.emplace_back(*logs[i], rows);
    }
  }
  return out;
}

Issue work_piece_issue(double kg) {
  return make_issue("work_piece_comes_and_goes", Severity::note,
                    fmt::format("a work piece of {:.3g} kg comes and goes in these logs: the robot is "
                                "identified from the rows without it",
                                kg));
}

/// Sets the days: the logs, or several pieces of a single log.
void set_days(HealthyRobot& robot) {
  robot.days = pointers(robot.logs);
  if (robot.days.size() != 1) return;
  LogSource& log = *robot.days.front();
  log.rewind();
  const Log all = read_all(log);
  robot.days.clear();
  for (int d = 0; d < kDaysOfOneLog; ++d) {
    robot.parts.push_back(std::make_unique<MemorySource>(
        slice(all, d * all.rows() / kDaysOfOneLog, (d + 1) * all.rows() / kDaysOfOneLog)));
    robot.days.push_back(robot.parts.back().get());
  }
}

}  // namespace

RobotRows rows_of(const HealthyRobot& robot, const std::vector<LogSource*>& days) {
  if (std::holds_alternative<BalanceModel>(robot.model.explain.robot)) return fitted_days(robot, days).model;
  return fit_coarse_days(days, robot.model.robot, robot.identification.space,
                         torque_between_samples(robot.model.robot));
}

HealthyRobot healthy_robot(std::span<LogSource* const> logs, const Robot& robot,
                           const IdentifyOptions& options, const Progress& progress) {
  Identification identification = identify(logs, robot, options, part_of(progress, 0.0, kFirst));
  std::vector<IdentifiedLog> given = identification.logs;
  if (progress) progress("learning what differs from day to day", kFirst);
  const bool is_coarse = identified_period_s(identification) > kCoarse_s;
  const bool doubtful = robot.payloads.empty() && has_doubtful_delay(identification, robot) && !is_coarse;
  HealthyRobot first =
      with_identification(logs, robot, doubtful ? as_stated(identification, robot) : identification, given);
  set_days(first);
  if (is_coarse) {
    learn_steps(first, first.days, options.threads);
    return first;
  }
  FittedDays fit = fitted_days(first, first.days);
  const Robot limited = with_drive_limits(robot, first, fit.model);
  std::deque<ConvertedTorqueSource> cut = within_limits(logs, limited);
  std::vector<LogSource*> sources = pointers(cut);
  std::deque<SelectedRowsSource> empty;
  if (robot.payloads.empty()) empty = without_work_piece(sources, first, fit);
  if (!empty.empty()) sources = pointers(empty);
  const bool is_better_known = !empty.empty() || limited.torque_limit != robot.torque_limit;
  if (!is_better_known && !doubtful) {
    take_rows(first, std::move(fit));
    return first;
  }
  if (is_better_known)
    identification = identify(sources, limited, options, part_of(progress, kFitted, kSecond));
  if (!empty.empty()) identification.issues.add(work_piece_issue(fit.model.piece_kg));
  if (progress) progress("learning what differs from day to day", kSecond);
  HealthyRobot second = with_identification(logs, robot, std::move(identification), std::move(given));
  set_days(second);
  take_rows(second, fitted_days(second, second.days));
  return second;
}

}  // namespace faultline
