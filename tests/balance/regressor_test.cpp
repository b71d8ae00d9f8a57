// SPDX-License-Identifier: MIT
#include "lib/balance/regressor.hpp"

#include <gtest/gtest.h>

#include "lib/core/random.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/fast_dynamics.hpp"
#include "lib/robot/robot.hpp"
#include "tests/support/chain_mechanics.hpp"

namespace faultline {
namespace {

JointVector draw(Random& random, int n) {
  JointVector v(n);
  for (int i = 0; i < n; ++i) v[i] = random.uniform(-2.0, 2.0);
  return v;
}

/// R, P about crossed and oblique axes, R again; every link with a full inertia; gravity not along an axis.
Chain crossed_chain(Random& random) {
  Robot robot = preset_robot("RRP");
  Chain chain = robot.chain;
  chain.geometry[1].axis = Eigen::Vector3d::UnitX();
  chain.geometry[1].kind = AxisKind::prismatic;
  chain.geometry[2].kind = AxisKind::revolute;
  chain.geometry[2].axis = Eigen::Vector3d(0.0, 0.6, 0.8);
  chain.geometry[2].offset = Eigen::Vector3d(0.1, -0.2, 0.3);
  chain.gravity = Eigen::Vector3d(1.0, -9.0, 3.0);
  for (auto& link : chain.links) {
    LinkVector v;
    for (int k = 0; k < kLinkParameters; ++k) v[k] = random.uniform(0.1, 1.0);
    v.segment<3>(4).array() += 3.0;
    link = link_from(v);
  }
  return chain;
}

Eigen::VectorXd stacked(const Chain& chain) {
  Eigen::VectorXd all(chain.joints() * kLinkParameters);
  for (int i = 0; i < chain.joints(); ++i)
    all.segment<kLinkParameters>(i * kLinkParameters) = to_vector(chain.links[i]);
  return all;
}

TEST(Regressor, TorqueEqualsInverseDynamics) {
  Random random(5);
  for (int k = 0; k < 20; ++k) {
    const Chain chain = crossed_chain(random);
    const auto q = draw(random, 3), dq = draw(random, 3), ddq = draw(random, 3);
    LinkRegressor y;
    torque_regressor(chain, q, dq, ddq, y);
    EXPECT_LT((y * stacked(chain) - rigid_body_torque(chain, q, dq, ddq, chain.gravity)).norm(), 1e-11);
  }
}

TEST(Regressor, MomentumEqualsInertiaTimesVelocity) {
  Random random(6);
  for (int k = 0; k < 20; ++k) {
    const Chain chain = crossed_chain(random);
    const auto q = draw(random, 3), dq = draw(random, 3);
    LinkRegressor y;
    momentum_regressor(link_frames(chain, q), dq, y);
    EXPECT_LT((y * stacked(chain) - momentum(chain, q, dq)).norm(), 1e-11);
  }
}

TEST(Regressor, ForceIsTheSlopeOfTheLagrangian) {
  Random random(7);
  for (int k = 0; k < 20; ++k) {
    const Chain chain = crossed_chain(random);
    const auto q = draw(random, 3), dq = draw(random, 3);
    LinkRegressor y;
    force_regressor(link_frames(chain, q), dq, y);
    const JointVector force = y * stacked(chain);
    for (int i = 0; i < 3; ++i) {
      JointVector up = q, down = q;
      up[i] += 1e-5;
      down[i] -= 1e-5;
      const double slope = (kinetic_energy(chain, up, dq) - potential_energy(chain, up) -
                            kinetic_energy(chain, down, dq) + potential_energy(chain, down)) /
                           2e-5;
      EXPECT_NEAR(force[i], slope, 1e-6);
    }
  }
}

void expect_same_momentum_and_force(const Chain& chain, Random& random) {
  const auto q = draw(random, chain.joints()), dq = draw(random, chain.joints());
  LinkRegressor momentum, force;
  momentum_regressor(link_frames(chain, q), dq, momentum);
  force_regressor(link_frames(chain, q), dq, force);
  const Eigen::VectorXd rotors =
      Eigen::Map<const Eigen::VectorXd>(chain.rotor_inertia.data(), chain.joints()).cwiseProduct(dq);
  JointVector p, f;
  FastDynamics(chain).momentum_and_force(q, dq, p, f);
  EXPECT_LT((momentum * stacked(chain) + rotors - p).norm(), 1e-11);
  EXPECT_LT((force * stacked(chain) - f).norm(), 1e-11);
}

TEST(Regressor, FastDynamicsGiveMomentumAndForceOfTheRegressorForParallelAxes) {
  Random random(8);
  for (const char* axes : {"RRP", "PRR", "RRR", "RRRP", "P"})
    for (const Eigen::Vector3d& gravity :
         {Eigen::Vector3d(0.0, 0.0, -9.81), Eigen::Vector3d(3.0, -9.0, -1.0)}) {
      SCOPED_TRACE(axes);
      Chain chain = preset_robot(axes).chain;
      chain.gravity = gravity;
      chain.rotor_inertia.assign(chain.joints(), 0.3);
      ASSERT_TRUE(FastDynamics(chain).planar());
      expect_same_momentum_and_force(chain, random);
    }
}

TEST(Regressor, FastDynamicsGiveMomentumAndForceOfTheRegressorForCrossedAxes) {
  Random random(9);
  for (int k = 0; k < 20; ++k) {
    Chain chain = crossed_chain(random);
    chain.rotor_inertia = {0.1, 0.2, 0.3};
    ASSERT_FALSE(FastDynamics(chain).planar());
    expect_same_momentum_and_force(chain, random);
  }
}

TEST(Regressor, ALinkFromAVectorHasTheSameVector) {
  LinkVector v;
  v << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10;
  EXPECT_EQ(to_vector(link_from(v)), v);
}

}  // namespace
}  // namespace faultline
