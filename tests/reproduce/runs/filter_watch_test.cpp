// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/filter_watch.hpp"

#include <gtest/gtest.h>

#include "lib/reproduce/runs/product_detector.hpp"

namespace faultline {
namespace {

constexpr double kSigma = 0.01;

TEST(FilterWatch, finds_and_names_each_free_joint_and_keeps_quiet_before) {
  const Robot robot = bench_robot();
  const HalfRanges ranges = half_ranges(robot, ControllerReading::held);
  const HealthyLogs healthy = healthy_logs(robot, ControllerReading::held, 20.0, ranges, kSigma, 3);
  const MotionModel model = motion_model_of(robot.chain, healthy, ranges, kSigma);
  const RunSet set{.faulty = 3, .fault_free_h = 0.0};
  const auto runs = with_noise(monitored_runs(robot, ControllerReading::held, set, 3, SeedUse::run_tuning),
                               ranges, kSigma, 3, SeedUse::run_tuning);
  for (const MonitoredRun& run : runs) {
    const auto alarms = watch_free_joints(model, run.log, {{14.0, 1e9}, 0.6});
    ASSERT_FALSE(alarms[0].empty()) << run.fault.joint;
    EXPECT_GE(alarms[0][0].time_s, run.onset_s);
    EXPECT_LT(alarms[0][0].time_s, run.onset_s + 1.0);
    EXPECT_EQ(alarms[0][0].label, run.fault);
    EXPECT_TRUE(alarms[1].empty());
  }
}

}  // namespace
}  // namespace faultline
