// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/free_joint_filter.hpp"

#include <gtest/gtest.h>

#include "lib/reproduce/runs/detectors.hpp"

namespace faultline {
namespace {

constexpr double kSigma = 0.01;

TEST(FreeJointFilter, FindsAndNamesEachFreeJointWithoutAnEarlierAlarm) {
  const Experiment experiment = experiment_on(bench_robot(), ControllerVariant::held, 3);
  const HealthyLogs healthy = healthy_logs(experiment, 20.0, kSigma);
  const FilteredRobot robot = with_missed_share(known_steps(experiment.robot, healthy), healthy.logs);
  const RunSet set{.faulty = 3, .fault_free_h = 0.0};
  const auto runs = with_noise(monitored_runs(experiment, set, SeedUse::run_tuning), experiment, kSigma,
                               SeedUse::run_tuning);
  for (const ExperimentRun& run : runs) {
    const auto alarms = free_joint_alarms(robot, run.log, {14.0, 1e9}, 0.6);
    ASSERT_FALSE(alarms[0].empty()) << run.fault.joint.number();
    EXPECT_GE(alarms[0][0].time_s, run.onset_s);
    EXPECT_LT(alarms[0][0].time_s, run.onset_s + 1.0);
    EXPECT_EQ(alarms[0][0].label, run.fault);
    EXPECT_TRUE(alarms[1].empty());
  }
}

}  // namespace
}  // namespace faultline
