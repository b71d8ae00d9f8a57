// SPDX-License-Identifier: MIT
#include "lib/pipeline/healthy_robot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "lib/core/make_issue.hpp"
#include "lib/evidence/learn/learn_motion_model.hpp"
#include "lib/pipeline/identified_model.hpp"
#include "lib/pipeline/without_work_piece.hpp"

namespace faultline {
namespace {

constexpr double kFirst = 0.6;  // share of the work that is done when the robot was identified once
constexpr double kMatched = 0.8;

/// Model and logs of `identification`; the logs are those that agreed when all were given.
HealthyRobot matched(std::span<LogSource* const> logs, const Robot& robot, Identification identification,
                     std::vector<IdentifiedLog> given, int threads) {
  HealthyRobot out;
  out.model = identified_model(identification);
  out.reading = reading_of(robot, out.model.robot);
  out.logs = in_time(logs, out.reading, given);
  out.model.motion = learn_motion_model(pointers(out.logs), identified_motion(identification),
                                        {.normal = out.model.robot.normal, .threads = threads});
  out.identification = std::move(identification);
  out.given = std::move(given);
  return out;
}

/// A mass that comes and goes looks like a torque that acts late: what such logs tell of a delay is not
/// believed while work pieces are looked for.
Identification as_stated(Identification identification, const Robot& robot) {
  identification.robot.torque_delay_s = robot.torque_delay_s;
  return identification;
}

bool has_doubtful_delay(const Identification& identification, const Robot& robot) {
  return identification.status != IdentificationStatus::converged &&
         identification.robot.torque_delay_s != robot.torque_delay_s;
}

/// The logs that agree, without the rows in which a work piece is carried; none where that is told of none.
std::deque<SelectedRowsSource> without_work_piece(std::span<LogSource* const> logs, HealthyRobot& robot,
                                                  int threads) {
  std::deque<SelectedRowsSource> out;
  const auto ranges = rows_without_work_piece(pointers(robot.logs), robot.model.motion, threads);
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

Issue work_piece_issue(const std::vector<double>& pieces) {
  return make_issue(
      "work_piece_comes_and_goes", Severity::note,
      fmt::format("a work piece of {:.3g} kg comes and goes in these logs: the robot is identified "
                  "from the rows without it",
                  fmt::join(pieces, ", ")));
}

}  // namespace

HealthyRobot healthy_robot(std::span<LogSource* const> logs, const Robot& robot,
                           const IdentifyOptions& options, const Progress& progress) {
  Identification identification = identify(logs, robot, options, part_of(progress, 0.0, kFirst));
  std::vector<IdentifiedLog> given = identification.logs;
  if (progress) progress("matching the noise", kFirst);
  const bool doubtful = robot.payloads.empty() && has_doubtful_delay(identification, robot);
  HealthyRobot first = matched(logs, robot, doubtful ? as_stated(identification, robot) : identification,
                               given, options.threads);
  if (!robot.payloads.empty()) return first;
  std::deque<SelectedRowsSource> empty = without_work_piece(logs, first, options.threads);
  if (empty.empty() && doubtful)
    return matched(logs, robot, std::move(identification), std::move(given), options.threads);
  if (empty.empty()) return first;
  std::vector<LogSource*> sources;
  for (SelectedRowsSource& log : empty) sources.push_back(&log);
  Identification again = identify(sources, robot, options, part_of(progress, kFirst, kMatched));
  again.issues.add(work_piece_issue(first.model.motion.work_pieces_kg));
  if (progress) progress("matching the noise", kMatched);
  return matched(logs, robot, std::move(again), std::move(first.given), options.threads);
}

}  // namespace faultline
