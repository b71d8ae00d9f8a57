// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lib/identify/identify.hpp"
#include "lib/log/memory_source.hpp"
#include "lib/robot/dynamics.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

using testing::ClosedFormRun;
using testing::ClosedFormScara;
using testing::simulate_closed_form;

Identification identified(const ClosedFormScara& scara, std::uint64_t seed = 1) {
  ClosedFormRun run;
  run.period_s = 0.002;
  run.duration_s = 10.0;
  run.seed = seed;
  MemorySource source(simulate_closed_form(scara, run), "log");
  LogSource* logs[] = {&source};
  Robot robot = preset_robot("RRP");
  robot.log.torque_between_samples = TorqueTiming::held;
  return identify(logs, robot);
}

bool kept(const Identification& id, const std::string& term) {
  return std::any_of(id.terms.begin(), id.terms.end(),
                     [&](const ModelTerm& t) { return t.name == term && t.kept; });
}

void expect_masses(const Identification& id, const ClosedFormScara& scara, double share) {
  const double truth[] = {scara.a(), scara.b(), scara.c(), scara.m3};
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(id.base_parameters[k].value / truth[k], 1.0, share) << id.base_parameters[k].name;
}

/// Torque of friction alone of joint `j` at `dq`.
double friction_at(const Identification& id, int j, double dq) {
  JointVector<double> speed = JointVector<double>::Zero(3);
  speed[j] = dq;
  return friction_torque(id.robot.chain, speed)[j];
}

TEST(FrictionTerms, APlainRobotGetsNeitherBendNorSkew) {
  for (const std::uint64_t seed : {1, 2}) {
    const Identification id = identified({}, seed);
    for (int j = 1; j <= 3; ++j) {
      EXPECT_FALSE(kept(id, "fb_" + std::to_string(j))) << seed;
      EXPECT_FALSE(kept(id, "fs_" + std::to_string(j))) << seed;
    }
  }
}

TEST(FrictionTerms, StribeckFrictionIsBentAndLeavesTheMassesRight) {
  ClosedFormScara scara;
  scara.stribeck = {2.4, 0.0, 0.0};
  const Identification id = identified(scara);
  EXPECT_TRUE(kept(id, "fb_1"));
  EXPECT_FALSE(kept(id, "fb_2"));
  EXPECT_LT(id.robot.chain.friction[0].bend, 0.0);
  expect_masses(id, scara, 0.01);
  for (const double dq : {0.15, 0.5, 1.0, 2.0}) {
    const double truth =
        scara.fv[0] * dq + scara.fc[0] + scara.stribeck[0] * std::exp(-std::pow(dq / 0.3, 2));
    EXPECT_NEAR(friction_at(id, 0, dq), truth, 0.25) << dq;
  }
}

TEST(FrictionTerms, ViscousFrictionThatDiffersByDirectionIsSkewed) {
  ClosedFormScara scara;
  scara.skew = {0.0, 0.15, 0.0};
  const Identification id = identified(scara);
  EXPECT_TRUE(kept(id, "fs_2"));
  EXPECT_FALSE(kept(id, "fs_1"));
  EXPECT_NEAR(id.robot.chain.friction[1].skew, 0.15, 0.01);
  expect_masses(id, scara, 0.002);
}

}  // namespace
}  // namespace faultline
