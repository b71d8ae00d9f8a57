// SPDX-License-Identifier: MIT
#include "lib/pipeline/watched_robot.hpp"

#include <utility>

#include "lib/evidence/bank.hpp"

namespace faultline {
namespace {

constexpr double kLearned = 0.9;  // share of the work that is done when the healthy robot is known

}  // namespace

WatchedRobot watched_robot(std::span<LogSource* const> logs, const Robot& robot,
                           const WatchedRobotOptions& options, const Progress& progress) {
  WatchedRobot out{healthy_robot(logs, robot, options.identify, part_of(progress, 0.0, kLearned)), {}};
  Model& model = out.robot.model;
  model.bank = hypotheses_of(model.robot.joints(), model.robot.log.torque, model.motion.work_pieces_kg);
  if (progress) progress("checking the alarm threshold", kLearned);
  CalibratedThresholds calibrated = calibrate_thresholds(pointers(out.robot.logs), model.motion, model.bank,
                                                         options.start, options.threads);
  model.evidence = std::move(calibrated.options);
  out.extremes = std::move(calibrated.logs);
  return out;
}

}  // namespace faultline
