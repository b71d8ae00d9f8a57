// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/reproduce/generator/generator_measurements.hpp"

namespace faultline {
namespace {

TEST(IdentifiedRobot, MassesAndFrictionAreIdentifiedFromLogsWithHeldTorque) {
  const Robot truth = bench_robot_with_friction();
  const Robot known = robot_as_known(TorqueTiming::held);
  EXPECT_EQ(known.known.size(), 1u);
  EXPECT_EQ(known.chain.friction[0].coulomb, 0.0);
  EXPECT_NE(known.chain.links[1].mass, truth.chain.links[1].mass);
  const Robot found =
      identified_robot(experiment_on(truth, ControllerVariant::held, 1), {.count = 1, .max_rows = 200});
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(found.chain.friction[j].coulomb, truth.chain.friction[j].coulomb, 1e-3);
    EXPECT_NEAR(found.chain.friction[j].viscous, truth.chain.friction[j].viscous, 1e-3);
  }
  EXPECT_NEAR(found.chain.links[2].mass, 0.5, 1e-4);
}

TEST(IdentifiedRobot, TheTimingOfATorqueThatIsNotHeldIsFoundHalfWay) {
  const Robot found = identified_robot(experiment_on(bench_robot(), ControllerVariant::fast, 1),
                                       {.count = 1, .max_rows = 300});
  ASSERT_TRUE(found.torque_phi);
  EXPECT_NEAR(*found.torque_phi, 0.5, 0.05);
}

}  // namespace
}  // namespace faultline
