// SPDX-License-Identifier: MIT
#include "lib/learn/tracking_model.hpp"

#include <algorithm>
#include <filesystem>

#include "lib/core/error.hpp"
#include "lib/core/statistics.hpp"
#include "lib/diagnose/monitor/log_tally.hpp"
#include "lib/log/quality.hpp"
#include "lib/residual/relation/learn_relations.hpp"

namespace faultline {
namespace {

/// Reads the whole log and returns its usual sample period, s; sets model.has_velocity.
double period_of(LogSource& log, const Robot& robot, Model& model) {
  QualityState state;
  log.rewind();
  for (Log segment; log.next(segment);) {
    check_joints(segment, log, "the robot file", robot.joints());
    model.has_velocity = model.has_velocity && !segment.dq.empty();
    assess(segment, state);
  }
  return quality_of(state).time.period_s;
}

}  // namespace

bool lack_torque(std::span<LogSource* const> logs) {
  return std::all_of(logs.begin(), logs.end(), [](LogSource* log) {
    log->rewind();
    Log first;
    const bool lacks = !log->next(first) || !has_torque(first);
    log->rewind();
    return lacks;
  });
}

Model tracking_model(std::span<LogSource* const> healthy, const Robot& robot, double alarms_per_hour) {
  Model model;
  model.name = robot.name;
  model.robot = robot;
  std::vector<double> periods;
  for (LogSource* log : healthy) {
    periods.push_back(period_of(*log, robot, model));
    const LogIdentity& identity = log->identity();
    model.sources.push_back({std::filesystem::path(identity.path).filename().string(), identity.sha256,
                             identity.rows_read, "none"});
  }
  model.sample_period_s = upper_median(periods);
  model.relations = learn_relations(healthy, {.period_s = model.sample_period_s,
                                              .least_share = robot.normal.model_error,
                                              .alarms_per_hour = alarms_per_hour});
  if (model.relations.empty())
    throw Error(
        ErrorCode::input, healthy.front()->identity().path,
        "has no torque, and no joint of it follows a reference (q_ref1.. with q1.., or dq_ref1.. with "
        "dq1..) that moves; map the columns in [log.columns] of the robot file");
  return model;
}

}  // namespace faultline
