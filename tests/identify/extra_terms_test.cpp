// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "lib/identify/identification_json.hpp"
#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/identify/closed_form_scara.hpp"
#include "tests/identify/identified_scara.hpp"
#include "tests/identify/two_mass_joint.hpp"

namespace faultline {
namespace {

using testing::ClosedFormRun;
using testing::ClosedFormScara;
using testing::expect_masses;
using testing::identified;
using testing::kept;
using testing::simulate_closed_form;
using testing::simulate_two_mass;
using testing::TwoMassJoint;

constexpr double kDuration_s = 12.0;

Identification identified_two_mass(const TwoMassJoint& joint) {
  MemorySource source(simulate_two_mass(joint, 30.0, 0.001), "log");
  LogSource* logs[] = {&source};
  return identify(logs, preset_robot("R"));
}

const ParameterEstimate* find(const Identification& id, const std::string& prefix) {
  for (const ParameterEstimate& e : id.base_parameters)
    if (e.name.starts_with(prefix)) return &e;
  return nullptr;
}

TEST(ExtraTerms, APlainRobotGetsNoExtraTerm) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    ClosedFormRun run;
    run.seed = seed;
    const Identification id = identified({}, kDuration_s, run);
    EXPECT_TRUE(id.space.extra.empty()) << seed;
    EXPECT_TRUE(id.robot.torque_gain.empty()) << seed;
  }
}

TEST(ExtraTerms, FrictionThatGrowsWithTheLoadIsFoundWithItsShare) {
  ClosedFormScara scara;
  scara.load = {0.08, 0.0, 0.0};
  const Identification id = identified(scara, kDuration_s);
  EXPECT_TRUE(kept(id, "fl_1"));
  EXPECT_FALSE(kept(id, "fl_2"));
  EXPECT_NEAR(id.robot.chain.friction[0].load, 0.08, 0.002);
  EXPECT_NEAR(id.robot.chain.friction[0].coulomb, scara.fc[0], 0.03);
  expect_masses(id, scara, 0.002);
}

TEST(ExtraTerms, KnownLoadFrictionIsKept) {
  ClosedFormScara scara;
  scara.load = {0.08, 0.0, 0.0};
  MemorySource source(simulate_closed_form(scara, {.duration_s = 8.0, .period_s = 0.002}), "log");
  LogSource* logs[] = {&source};
  const Identification id = identify(logs, robot_from_toml("axes = \"RRP\"\n[known]\nfl1 = 0.08\n", "robot"));
  EXPECT_EQ(id.robot.chain.friction[0].load, 0.08);
  expect_masses(id, scara, 0.003);
}

TEST(ExtraTerms, RippleIsFoundWithItsRateAndSize) {
  ClosedFormScara scara;
  scara.ripple = {0.0, 0.6, 0.0};
  const Identification id = identified(scara, kDuration_s);
  ASSERT_EQ(id.robot.chain.ripples.size(), 1U);
  const Ripple& r = id.robot.chain.ripples[0];
  EXPECT_EQ(r.joint, 2_joint);
  EXPECT_NEAR(r.rate, 25.0, 0.05);
  EXPECT_NEAR(r.sine, 0.6 * std::cos(0.6), 0.02);
  EXPECT_NEAR(r.cosine, 0.6 * std::sin(0.6), 0.02);
  expect_masses(id, scara, 0.002);
}

TEST(ExtraTerms, FrictionOfADriveThatTwoJointsTurnIsFound) {
  ClosedFormScara scara;
  scara.shared_fv = 0.4;
  scara.shared_fc = 1.5;
  const Identification id = identified(scara, kDuration_s);
  ASSERT_EQ(id.robot.chain.shared_drives.size(), 1U);
  const SharedDrive& f = id.robot.chain.shared_drives[0];
  EXPECT_EQ(f.along, Eigen::Vector3d(1, 1, 0));
  EXPECT_NEAR(f.viscous, 0.4, 0.02);
  EXPECT_NEAR(f.coulomb, 1.5, 0.05);
  EXPECT_EQ(find(id, "fc_+1+2")->unit, "N m");
  EXPECT_NEAR(f.rotor_inertia, 0.0, 0.01);
  expect_masses(id, scara, 0.005);
}

TEST(ExtraTerms, ATorqueConstantThatTheOtherJointContradictsIsFound) {
  ClosedFormScara scara;
  ClosedFormRun run;
  run.torque_gain = {1.0, 1.15, 1.0};
  const Identification id = identified(scara, kDuration_s, run);
  ASSERT_EQ(id.robot.torque_gain.size(), 3U);
  EXPECT_NEAR(id.robot.torque_gain[1], 1.15, 0.005);
  EXPECT_EQ(id.robot.torque_gain[2], 1.0);
  EXPECT_NE(id.issues.find("torque_gain_2"), nullptr);
  expect_masses(id, scara, 0.003);
}

TEST(ExtraTerms, LoadFrictionBesideATorqueConstantRefersToTheTrueTorque) {
  ClosedFormScara scara;
  scara.load = {0.08, 0.08, 0.0};
  ClosedFormRun run;
  run.torque_gain = {1.0, 1.15, 1.0};
  const Identification id = identified(scara, kDuration_s, run);
  ASSERT_EQ(id.robot.torque_gain.size(), 3U);
  EXPECT_NEAR(id.robot.torque_gain[1], 1.15, 0.005);
  EXPECT_NEAR(id.robot.chain.friction[0].load, 0.08, 0.002);
  EXPECT_NEAR(id.robot.chain.friction[1].load, 0.08, 0.002);
  expect_masses(id, scara, 0.003);
}

TEST(ExtraTerms, AnElasticGearIsFoundWithItsCompliance) {
  const TwoMassJoint joint;
  const Identification id = identified_two_mass(joint);
  EXPECT_TRUE(kept(id, "gc_1"));
  ASSERT_EQ(id.robot.gear_compliance.size(), 1U);
  const double seen = std::pow(joint.link_inertia / joint.inertia(), 2) / joint.stiffness;
  EXPECT_NEAR(id.robot.gear_compliance[0] / seen, 1.0, 0.15);
  EXPECT_NEAR(id.base_parameters[0].value / joint.inertia(), 1.0, 0.01);
}

TEST(ExtraTerms, AStiffGearHasNoCompliance) {
  TwoMassJoint joint;
  joint.stiffness = 3e6;
  const Identification id = identified_two_mass(joint);
  EXPECT_FALSE(kept(id, "gc_1"));
}

TEST(ExtraTerms, TheIdentificationIsReadBackFromItsJson) {
  ClosedFormScara scara;
  scara.load = {0.08, 0.0, 0.0};
  scara.ripple = {0.0, 0.6, 0.0};
  const Identification id = identified(scara, kDuration_s);
  const Identification again = identification_from_json(to_json(id), "again");
  EXPECT_EQ(robot_file_text(again.robot), robot_file_text(id.robot));
  EXPECT_EQ(again.estimate, id.estimate);
  for (int p = 0; p < id.space.count(); ++p) EXPECT_EQ(again.space.name(p), id.space.name(p));
}

}  // namespace
}  // namespace faultline
