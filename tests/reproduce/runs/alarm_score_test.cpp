// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/alarm_score.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

ExperimentRun run_of(double length_s, Joint joint, double onset_s) {
  ExperimentRun run;
  run.log.time = {0.0, length_s};
  if (!joint.is_none()) run.fault = {FaultKind::free_swinging, joint};
  if (!joint.is_none()) run.onset_s = onset_s;
  return run;
}

TEST(AlarmScore, CountsAlarmsBeforeTheOnsetAsFalseAndTheFirstAfterItAsDetection) {
  AlarmScore score;
  const FaultLabel right{FaultKind::free_swinging, 2_joint}, wrong{FaultKind::free_swinging, 1_joint};
  score.add(run_of(20.0, 2_joint, 10.0), {{3.0, right}, {10.5, wrong}, {11.0, right}});
  score.add(run_of(20.0, 2_joint, 10.0), {{11.0, {FaultKind::torque_loss, 2_joint}}});
  score.add(run_of(20.0, 2_joint, 10.0), {});
  score.add(run_of(3600.0, Joint(), 0.0), {{5.0, right}, {6.0, wrong}});
  EXPECT_EQ(score.false_alarms, 3);
  EXPECT_NEAR(score.fault_free_h, 1.0 + 30.0 / 3600.0, 1e-12);
  EXPECT_NEAR(score.detected(), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(score.right_joint(), 0.5, 1e-12);
  EXPECT_NEAR(score.right_kind(), 0.0, 1e-12);
  EXPECT_NEAR(score.delay_quantile(0.5), 0.5, 1e-12);
  EXPECT_NEAR(score.delay_quantile(0.9), 1.0, 1e-12);
}

TEST(AlarmScore, HasNoDelayIfNothingWasFound) {
  AlarmScore score;
  score.add(run_of(20.0, 1_joint, 10.0), {});
  EXPECT_EQ(score.detected(), 0.0);
  EXPECT_TRUE(std::isnan(score.delay_quantile(0.5)));
  EXPECT_TRUE(std::isnan(score.right_joint()));
}

}  // namespace
}  // namespace faultline
