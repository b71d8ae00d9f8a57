// SPDX-License-Identifier: MIT
#include "lib/explain/decide_log.hpp"

#include <gtest/gtest.h>

namespace faultline {
namespace {

TEST(EvidenceLimits, TheUnknownFaultOfAHealthyLogSetsTheLimitOfUnknownFaults) {
  LogExplanation loud;
  loud.free_gain = 150.0;
  EXPECT_EQ(evidence_limits({loud}).of(FaultKind::unknown), 450.0);
  EXPECT_EQ(evidence_limits({loud}).of(FaultKind::collision), 100.0);
}

TEST(EvidenceLimits, AHealthyLogLimitsCollisionsByWhatItLeavesInTheRowsOfOnePush) {
  LogExplanation wandering;
  wandering.best.emplace_back().kind = FaultKind::torque_loss;
  wandering.best.front().gain = 400.0;
  wandering.most_of_a_push = 130.0;
  const EvidenceLimits limits = evidence_limits({wandering});
  EXPECT_EQ(limits.of(FaultKind::torque_loss), 1200.0);
  EXPECT_EQ(limits.of(FaultKind::friction_increase), 400.0);
  EXPECT_EQ(limits.of(FaultKind::collision), 130.0);
}

}  // namespace
}  // namespace faultline
