// SPDX-License-Identifier: MIT
#include "lib/reproduce/protocol/protocol.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace faultline {
namespace {

TEST(Protocol, ATrajectoryOf25SamplesGives25TransitionsOf73Milliseconds) {
  for (const ControllerVariant controller : kControllerVariants) {
    const Log log = trajectory(bench_robot(), controller, 25, 3);
    EXPECT_EQ(log.rows(), 26) << to_string(controller);
    EXPECT_GT(std::abs(log.q[0][25] - log.q[0][0]), 0.1);
    const Transitions transitions = transitions_of({log, log});
    EXPECT_EQ(transitions.count(), 50);
    EXPECT_NEAR(transitions.duration[0], kSamplePeriod, 1e-12);
  }
}

TEST(Protocol, TheFirstHeldTorqueOfAQuinticFromRestOnlyCarriesTheWeight) {
  const Log log = trajectory(bench_robot(), ControllerVariant::held, 10, 5);
  EXPECT_NEAR(log.tau[0][0], 0.0, 1e-9);
  EXPECT_NEAR(log.tau[1][0], 0.0, 1e-9);
  EXPECT_NEAR(log.tau[2][0], 0.5 * 9.81, 1e-9);
}

TEST(Protocol, NoiseHasTheGivenStandardDeviationInHalfRanges) {
  const Robot robot = bench_robot();
  const HalfRanges ranges = half_ranges(robot, ControllerVariant::held);
  Log log = run_of_moves(robot, ControllerVariant::held, {.duration_s = 600.0}, 7);
  const Log clean = log;
  add_noise(log, ranges, 0.1, 9);
  for (int j = 0; j < 3; ++j) {
    double q = 0.0, dq = 0.0;
    for (int k = 0; k < log.rows(); ++k) {
      q += std::pow((log.q[j][k] - clean.q[j][k]) / ranges.q[j], 2);
      dq += std::pow((log.dq[j][k] - clean.dq[j][k]) / ranges.dq[j], 2);
    }
    EXPECT_NEAR(std::sqrt(q / log.rows()), 0.1, 0.005);
    EXPECT_NEAR(std::sqrt(dq / log.rows()), 0.1, 0.005);
    EXPECT_EQ(log.tau[j], clean.tau[j]);
  }
}

TEST(Protocol, UsesAndItemsDrawDifferentSeeds) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (int use = 0; use < 10; ++use)
      for (std::uint64_t item = 0; item < 20; ++item) seen.insert(seed_of(seed, SeedUse(use), item));
  EXPECT_EQ(seen.size(), 1000u);
}

}  // namespace
}  // namespace faultline
