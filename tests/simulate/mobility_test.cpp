// SPDX-License-Identifier: MIT
#include "lib/simulate/mobility.hpp"

#include <gtest/gtest.h>

#include "tests/simulate/one_joint.hpp"
#include "tests/simulate/short_runs.hpp"

namespace faultline {
namespace {

TEST(Mobility, TheMobilityOfARodIsOneOverItsInertia) {
  EXPECT_NEAR(mobility(FastDynamics(one_joint().chain))[0], 1.0 / kRodInertia, 1e-9);
}

TEST(Mobility, ARobotWhoseFrictionIsSlowIsUnchanged) {
  const Robot robot = with_slow_friction(industrial(), 5e-4);
  for (const double rotor : robot.chain.rotor_inertia) EXPECT_EQ(rotor, 0.0);
}

TEST(Mobility, FrictionThatSlowsARodTooFastGetsARotorThatMakesItSlowEnough) {
  Robot rod = one_joint();
  rod.chain.friction[0].viscous = 1000.0;  // slows the rod of 0.12 kg m^2 in 0.12 ms
  const Robot slow = with_slow_friction(rod, 5e-4);
  EXPECT_NEAR(slow.chain.rotor_inertia[0], 0.5 - kRodInertia, 1e-9);
  EXPECT_NEAR(1000.0 * mobility(FastDynamics(slow.chain))[0], 1.0 / 5e-4, 1e-6);
}

}  // namespace
}  // namespace faultline
