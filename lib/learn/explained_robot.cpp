// SPDX-License-Identifier: MIT
#include "lib/learn/explained_robot.hpp"

#include <algorithm>
#include <utility>

#include "lib/core/parallel.hpp"
#include "lib/core/statistics.hpp"
#include "lib/learn/day_differences.hpp"

namespace faultline {
namespace {

constexpr double kSlack = 1.25;        // length of a window over the median length of a healthy log
constexpr double kHealthyKnown = 0.8;  // share of the work that is done when the healthy robot is known

/// Returns the rows with the meaning of the torque and the ranges of days from the robot file.
RobotRows as_stated(RobotRows rows, const Model& model) {
  const bool is_measured = model.robot.log.torque == TorqueMeaning::measured;
  std::visit([&](auto& each) { each.torque_is_measured = is_measured; }, rows);
  return with_stated_ranges(std::move(rows), model.robot.normal, model.motion.torque_scale);
}

/// Length of a window, s: a little longer than the logs that the limits come from, so that a log of their
/// length is one window.
double window_s(const std::vector<UniformLog>& logs) {
  std::vector<double> length_s;
  for (const UniformLog& log : logs) length_s.push_back(log.rows() * log.period_s);
  if (length_s.empty()) return ExplainModel::kLongestWindow_s;
  return std::clamp(kSlack * upper_median(std::move(length_s)), ExplainModel::kShortestWindow_s,
                    ExplainModel::kLongestWindow_s);
}

}  // namespace

ExplainedRobot explained_robot(std::span<LogSource* const> logs, const Robot& robot,
                               const ExplainedRobotOptions& options, const Progress& progress) {
  ExplainedRobot out{
      healthy_robot(logs, robot, options.identify, part_of(progress, 0.0, kHealthyKnown)), {}, {}};
  if (progress) progress("judging each log by the others", kHealthyKnown);
  HealthyRobot& healthy = out.robot;
  Model& model = healthy.model;
  model.explain.robot = as_stated(std::move(model.explain.robot), model);
  model.labels = labels_of(model.robot);
  std::vector<UniformLog>& uniform = out.logs;
  for (LogSource* day : healthy.days) {
    day->rewind();
    uniform.push_back(uniform_log(*day, model.sample_period_s));
  }
  out.left_out.resize(uniform.size());
  parallel_for(static_cast<int>(uniform.size()), options.threads, [&](int k) {
    const RobotRows others = as_stated(std::move(healthy.without[k]), model);
    if (can_explain(uniform[k], others)) out.left_out[k] = explain_healthy(uniform[k], others);
  });
  model.explain.limits = raised(evidence_limits(out.left_out), options.limit_shift);
  model.explain.window_s = window_s(uniform);
  return out;
}

EvidenceLimits raised(EvidenceLimits limits, double nats) {
  for (double& each : limits.nats) each += nats;
  return limits;
}

}  // namespace faultline
