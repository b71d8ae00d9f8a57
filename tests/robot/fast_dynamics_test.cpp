// SPDX-License-Identifier: MIT
#include "lib/robot/fast_dynamics.hpp"

#include <gtest/gtest.h>

#include "lib/core/random.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/robot.hpp"
#include "tests/support/chain_mechanics.hpp"

namespace faultline {
namespace {

JointVector draw(Random& random, int n, double scale) {
  JointVector v(n);
  for (int i = 0; i < n; ++i) v[i] = random.uniform(-scale, scale);
  return v;
}

Eigen::Vector3d draw3(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

/// Every link a general body with off-axis centre and full tensor, offsets everywhere, friction and rotors.
Chain scrambled(Chain chain, Random& random) {
  for (int i = 0; i < chain.joints(); ++i) {
    Eigen::Matrix3d root;
    root << draw3(random), draw3(random), draw3(random);
    chain.links[i] =
        general_body(random.uniform(0.5, 2.0), 0.3 * draw3(random), 0.1 * root * root.transpose());
    chain.geometry[i].offset = 0.4 * draw3(random);
    chain.length[i] = random.uniform(0.2, 1.0);
    if (random.uniform() < 0.4) chain.geometry[i].axis *= -1.0;
    chain.friction[i] = {random.uniform(0, 2), random.uniform(0, 3), random.uniform(-1, 1),
                         random.uniform(0.01, 1)};
    chain.rotor_inertia[i] = random.uniform(0, 0.1);
  }
  return chain;
}

void expect_equals_general(const Chain& chain, Random& random) {
  const FastDynamics fast(chain);
  const int n = chain.joints();
  JointMatrix m;
  JointVector bias, friction, ddq;
  for (int k = 0; k < 20; ++k) {
    const auto q = draw(random, n, 3.0), dq = draw(random, n, 2.0), tau = draw(random, n, 10.0);
    fast.inertia_and_bias(q, dq, m, bias);
    fast.friction(dq, friction);
    fast.acceleration(q, dq, tau, ddq);
    const JointVector needed = rigid_body_torque(chain, q, dq, tau, chain.gravity);
    EXPECT_LT((fast.body_torque(q, dq, tau) - needed).norm(), 1e-12 * needed.norm());
    EXPECT_LT((m - inertia_matrix(chain, q)).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((bias - bias_torque(chain, q, dq)).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LT((friction - friction_torque(chain, dq)).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((ddq - forward_dynamics(chain, q, dq, tau)).norm(), 1e-9 * (1.0 + ddq.norm()));
  }
}

TEST(FastDynamics, EqualsTheGeneralPathForEveryPreset) {
  Random random(11);
  for (const char* axes : {"RRP", "RRPR", "RPRR", "RR", "R", "P"}) {
    SCOPED_TRACE(axes);
    for (int k = 0; k < 5; ++k) {
      Chain chain = scrambled(preset_robot(axes).chain, random);
      EXPECT_TRUE(FastDynamics(chain).planar());
      expect_equals_general(chain, random);
      chain.gravity = 9.81 * draw3(random).normalized();
      expect_equals_general(chain, random);
    }
  }
}

TEST(FastDynamics, EqualsTheGeneralPathAlongAnyCommonNormal) {
  Random random(12);
  for (int k = 0; k < 10; ++k) {
    Chain chain = scrambled(preset_robot("RRPR").chain, random);
    const Eigen::Vector3d normal = draw3(random).normalized();
    for (JointGeometry& joint : chain.geometry) {
      joint.axis = normal;
      joint.direction = joint.direction.isZero() ? joint.direction : draw3(random).normalized();
    }
    expect_equals_general(chain, random);
  }
}

TEST(FastDynamics, EqualsTheGeneralPathForAxesThatCross) {
  Random random(13);
  for (const char* axes : {"RRP", "PRRR", "RPRR", "RRRRRR"}) {
    SCOPED_TRACE(axes);
    for (int k = 0; k < 5; ++k) {
      Chain chain = scrambled(preset_robot(axes).chain, random);
      for (JointGeometry& joint : chain.geometry) joint.axis = draw3(random).normalized();
      chain.gravity = 9.81 * draw3(random).normalized();
      EXPECT_FALSE(FastDynamics(chain).planar());
      expect_equals_general(chain, random);
      chain.shared_drives.push_back(
          {Eigen::VectorXd::LinSpaced(chain.joints(), 0.5, 2.0), 0.3, 0.4, 0.1, 0.2});
      expect_equals_general(chain, random);
    }
  }
}

TEST(FastDynamics, ALockedJointStaysAndTheOtherJointsObeyTheirEquations) {
  Random random(14);
  const Chain chain = scrambled(preset_robot("RRP").chain, random);
  const FastDynamics fast(chain);
  const auto q = draw(random, 3, 2.0), tau = draw(random, 3, 5.0);
  auto dq = draw(random, 3, 2.0);
  dq[1] = 0.0;
  JointVector ddq;
  fast.acceleration(q, dq, tau, ddq, 1u << 1);
  EXPECT_EQ(ddq[1], 0.0);
  const auto needed = inverse_dynamics(chain, q, dq, ddq);
  EXPECT_NEAR(needed[0], tau[0], 1e-9);
  EXPECT_NEAR(needed[2], tau[2], 1e-9);
  EXPECT_GT(std::abs(needed[1] - tau[1]), 1e-3);  // the lock holds what is missing
}

}  // namespace
}  // namespace faultline
