// SPDX-License-Identifier: MIT
#include "lib/simulate/fault_event.hpp"

#include <gtest/gtest.h>

#include "lib/core/error.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

bool changes_motion(const MachineFault& f) {
  return f.torque_gain != 1.0 || f.external_torque != 0.0 || f.drive_offset != 0.0 || f.coulomb != 0.0 ||
         f.viscous != 0.0 || f.payload != 0.0 || f.locks;
}

bool changes_readings(const MachineFault& f) {
  return f.reading_offset != 0.0 || f.reading_drift_per_s != 0.0 || f.reading_sticks;
}

TEST(MachineFault, ActsOnTheMachineAsTheCatalogueDescribes) {
  for (int k = 0; k < static_cast<int>(FaultKind::unknown); ++k) {
    const FaultDescription& kind = describe(static_cast<FaultKind>(k));
    const MachineFault fault =
        machine_fault({.kind = kind.kind, .joint = 1_joint, .onset_s = 1.0, .size = 0.5, .viscous = 0.25});
    EXPECT_EQ(changes_motion(fault), kind.acts_on == FaultActsOn::motion) << kind.name;
    EXPECT_EQ(changes_readings(fault), kind.acts_on == FaultActsOn::sensor) << kind.name;
  }
}

TEST(CheckFault, APayloadMustLeaveItsLinkAPositiveMass) {
  const Robot robot = known_rrp();
  const double mass = robot.chain.links[1].mass;
  const auto payload = [](Joint link, double kg) {
    return SimulatedFault{.kind = FaultKind::payload_change, .joint = link, .onset_s = 1.0, .size = kg};
  };
  EXPECT_NO_THROW(check_fault(robot, payload(2_joint, -0.9 * mass)));
  EXPECT_THROW(check_fault(robot, payload(2_joint, -1.1 * mass)), Error);
  EXPECT_NO_THROW(check_fault(robot, payload(Joint(), 0.5))) << "the last link";
  EXPECT_THROW(check_fault(robot, payload(4_joint, 0.5)), Error);
}

TEST(SizeUnit, FollowsFromTheTypeOfTheJoint) {
  const Robot robot = known_rrp();
  auto unit = [&](FaultKind kind, Joint joint) { return size_unit(robot, {.kind = kind, .joint = joint}); };
  EXPECT_EQ(unit(FaultKind::torque_loss, 1_joint), "1");
  EXPECT_EQ(unit(FaultKind::sensor_bias, 1_joint), "rad");
  EXPECT_EQ(unit(FaultKind::sensor_bias, 3_joint), "m");
  EXPECT_EQ(unit(FaultKind::sensor_drift, 3_joint), "m/s");
  EXPECT_EQ(unit(FaultKind::friction_increase, 1_joint), "N m") << "its size is the Coulomb friction";
  EXPECT_EQ(unit(FaultKind::collision, 3_joint), "N");
  EXPECT_EQ(unit(FaultKind::payload_change, Joint()), "kg");
  EXPECT_EQ(unit(FaultKind::locked, 1_joint), "");
  EXPECT_EQ(unit(FaultKind::collision, 9_joint), "");
}

}  // namespace
}  // namespace faultline
