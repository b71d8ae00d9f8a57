// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/reproduce/runs/alarm_score.hpp"

namespace faultline {
namespace {

const RunSet kSet{.faulty = 6, .fault_free_h = 0.05, .hour_s = 100.0};

Experiment held_experiment() { return experiment_on(bench_robot(), ControllerVariant::held, 1); }

TEST(MonitoredRuns, HaveTheRequestedFaultsOnsetsAndHours) {
  const auto runs = monitored_runs(held_experiment(), kSet, SeedUse::run_test);
  double fault_free_s = 0.0;
  int faulty = 0;
  for (const ExperimentRun& run : runs) {
    if (!run.faulty()) {
      fault_free_s += run.log.rows() * kSamplePeriod;
      continue;
    }
    EXPECT_EQ(run.fault, (FaultLabel{FaultKind::free_swinging, Joint::at(faulty++ % 3)}));
    EXPECT_GE(run.onset_s, 2.0);
    EXPECT_LE(run.onset_s, 20.0);
    EXPECT_GT(run.log.time.back(), run.onset_s);
    EXPECT_LE(run.log.time.back(), run.onset_s + 6.0);
  }
  EXPECT_EQ(faulty, 6);
  EXPECT_NEAR(fault_free_s, 180.0, 1.0);
}

TEST(MonitoredRuns, OfDifferentUsesDifferAndNoiseDoesNotChangeTheTorque) {
  const Experiment experiment = held_experiment();
  const auto runs = monitored_runs(experiment, kSet, SeedUse::run_test);
  const auto others = monitored_runs(experiment, kSet, SeedUse::run_tuning);
  EXPECT_NE(runs[0].onset_s, others[0].onset_s);
  const auto noisy = with_noise(runs, experiment, 0.1, SeedUse::run_test);
  EXPECT_EQ(noisy[0].log.tau, runs[0].log.tau);
  EXPECT_NE(noisy[0].log.q[0][5], runs[0].log.q[0][5]);
}

}  // namespace
}  // namespace faultline
