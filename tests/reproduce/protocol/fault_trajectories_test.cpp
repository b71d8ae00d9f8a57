// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lib/reproduce/protocol/protocol.hpp"

namespace faultline {
namespace {

TEST(FaultTrajectories, TheTrainingSetIsThatOfTable1) {
  const Experiment experiment = experiment_on(bench_robot(), ControllerVariant::held, 3);
  const FaultPatterns patterns = fault_patterns(experiment, {}, SeedUse::classifier_training);
  EXPECT_EQ(patterns.count(), 900);
  const int expected[] = {200, 200, 350, 150};
  for (int output = 0; output < kFaultClasses; ++output)
    EXPECT_EQ(patterns.of_class[output].count(), expected[output]);
  EXPECT_NEAR(table_1_prior().sum(), 1.0, 1e-12);
  EXPECT_NEAR(table_1_prior()[2], 35.0 / 90.0, 1e-12);
}

TEST(FaultTrajectories, AnyNumberHasTheMixOfTable1) {
  const Experiment experiment = experiment_on(bench_robot(), ControllerVariant::held, 3);
  const FaultPatterns patterns = fault_patterns(experiment, {.count = 45}, SeedUse::classifier_test);
  for (int output = 0; output < kFaultClasses; ++output)
    EXPECT_NEAR(patterns.of_class[output].count() / 450.0, table_1_prior()[output], 0.03);
}

TEST(FaultTrajectories, AFreeThirdJointFallsAndAHealthyOneIsHeld) {
  const Experiment experiment = experiment_on(bench_robot(), ControllerVariant::held, 3);
  const FaultPatterns patterns = fault_patterns(experiment, {.count = 9}, SeedUse::classifier_test);
  const Transitions& fallen = patterns.of_class[2];
  for (int i = 0; i < fallen.count(); ++i)
    EXPECT_NEAR((fallen.next_dq(2, i) - fallen.dq(2, i)) / kSamplePeriod, -9.81, 1e-6);
  const Transitions& healthy = patterns.of_class[3];
  EXPECT_LT((healthy.next_dq.row(2) - healthy.dq.row(2)).cwiseAbs().maxCoeff(), 0.3);
}

}  // namespace
}  // namespace faultline
