// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lib/identify/identify.hpp"
#include "lib/robot/dynamics.hpp"
#include "tests/identify/closed_form_scara.hpp"
#include "tests/identify/identified_scara.hpp"

namespace faultline {
namespace {

using testing::ClosedFormRun;
using testing::ClosedFormScara;
using testing::expect_masses;
using testing::identified;
using testing::kept;

constexpr double kDuration_s = 10.0;

/// Torque of friction alone of joint `j` at `dq`.
double friction_at(const Identification& id, int j, double dq) {
  JointVector speed = JointVector::Zero(3);
  speed[j] = dq;
  return friction_torque(id.robot.chain, speed)[j];
}

TEST(FrictionTerms, APlainRobotGetsNeitherBendNorSkew) {
  for (const std::uint64_t seed : {1, 2}) {
    ClosedFormRun run;
    run.seed = seed;
    const Identification id = identified({}, kDuration_s, run);
    for (int j = 1; j <= 3; ++j) {
      EXPECT_FALSE(kept(id, "fb_" + std::to_string(j))) << seed;
      EXPECT_FALSE(kept(id, "fs_" + std::to_string(j))) << seed;
    }
  }
}

TEST(FrictionTerms, StribeckFrictionGetsABendAndTheMassesStayCorrect) {
  ClosedFormScara scara;
  scara.stribeck = {2.4, 0.0, 0.0};
  const Identification id = identified(scara, kDuration_s);
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

TEST(FrictionTerms, ViscousFrictionThatDiffersByDirectionGetsASkew) {
  ClosedFormScara scara;
  scara.skew = {0.0, 0.15, 0.0};
  const Identification id = identified(scara, kDuration_s);
  EXPECT_TRUE(kept(id, "fs_2"));
  EXPECT_FALSE(kept(id, "fs_1"));
  EXPECT_NEAR(id.robot.chain.friction[1].skew, 0.15, 0.01);
  expect_masses(id, scara, 0.002);
}

}  // namespace
}  // namespace faultline
