// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lib/robot/dynamics.hpp"
#include "tests/robot/assorted_chains.hpp"
#include "tests/support/chain_mechanics.hpp"

/// Arms whose equations are in textbooks.
namespace faultline {
namespace {

using Vector = JointVector;

TEST(KnownArms, VerticalRRIsTheTextbookDoublePendulum) {
  // Point masses at the ends of massless rods; angles from the downward vertical, q1 = theta1,
  // q2 = theta2 - theta1. (m1+m2) l1^2 th1'' + m2 l1 l2 cos(d) th2'' + m2 l1 l2 sin(d) th2'^2
  // + (m1+m2) g l1 sin th1 = 0 and m2 l2^2 th2'' + m2 l1 l2 cos(d) th1'' - m2 l1 l2 sin(d) th1'^2
  // + m2 g l2 sin th2 = 0, d = th1 - th2.
  const double m1 = 1.2, m2 = 0.7, l1 = 0.5, l2 = 0.4, g = 9.81;
  Robot robot = preset_robot("RR");
  robot.chain.gravity = {g, 0.0, 0.0};  // along x: links hang at q = 0
  robot.chain.length = {l1, l2};
  robot.chain.links[0] = general_body(m1, {l1, 0, 0}, Eigen::Matrix3d::Zero());
  robot.chain.links[1] = general_body(m2, {l2, 0, 0}, Eigen::Matrix3d::Zero());
  Random random(30);
  for (int k = 0; k < 20; ++k) {
    const Vector q = draw(random, 2, 3.0), dq = draw(random, 2, 3.0);
    const Vector ddq = forward_dynamics(robot.chain, q, dq, Vector(Vector::Zero(2)));
    const double th1 = q[0], th2 = q[0] + q[1], w1 = dq[0], w2 = dq[0] + dq[1];
    const double a1 = ddq[0], a2 = ddq[0] + ddq[1], c = std::cos(th1 - th2), s = std::sin(th1 - th2);
    EXPECT_NEAR(
        (m1 + m2) * l1 * l1 * a1 + m2 * l1 * l2 * (c * a2 + s * w2 * w2) + (m1 + m2) * g * l1 * std::sin(th1),
        0.0, 1e-9);
    EXPECT_NEAR(m2 * l2 * l2 * a2 + m2 * l1 * l2 * (c * a1 - s * w1 * w1) + m2 * g * l2 * std::sin(th2), 0.0,
                1e-9);
  }
}

TEST(KnownArms, ScaraOrdersAgreeOnTheSameArm) {
  // An RRPR whose tool has no inertia about its axis besides its mass is the RRP; an RPRR with the lift first
  // carries the arm on the lift: its R joints feel what an RR arm feels, its P joint the weight of all.
  Random random(31);
  Robot rrp = preset_robot("RRP"), rrpr = preset_robot("RRPR");
  rrp = with_masses_and_lengths(rrp, {2.0, 1.5, 1.2}, {0.5, 0.4, 0.0});
  rrpr = with_masses_and_lengths(rrpr, {2.0, 1.5, 0.7, 0.0}, {0.5, 0.4, 0.0, 0.0});
  rrpr.chain.links[3] = general_body(0.5, {0, 0, -0.1}, 1e-3 * Eigen::Matrix3d::Identity());
  const Vector q = draw(random, 4, 1.0), dq = draw(random, 4, 1.0), ddq = draw(random, 4, 2.0);
  const Vector three =
      inverse_dynamics(rrp.chain, Vector(q.head(3)), Vector(dq.head(3)), Vector(ddq.head(3)));
  const Vector four = inverse_dynamics(rrpr.chain, q, dq, ddq);
  const double tool = 1e-3 * (ddq[0] + ddq[1] + ddq[3]);
  EXPECT_NEAR(four[0], three[0] + tool, 1e-12);
  EXPECT_NEAR(four[1], three[1] + tool, 1e-12);
  EXPECT_NEAR(four[2], three[2], 1e-12);
  EXPECT_NEAR(four[3], tool, 1e-12);

  Robot rprr = preset_robot("RPRR");
  rprr = with_masses_and_lengths(rprr, {2.0, 1.0, 1.5, 0.5}, {0.3, 0.0, 0.5, 0.4});
  const Vector tau = inverse_dynamics(rprr.chain, q, dq, ddq);
  EXPECT_NEAR(tau[1], (1.0 + 1.5 + 0.5) * (ddq[1] + 9.81), 1e-12);
  Robot rr = preset_robot("RR");
  rr = with_masses_and_lengths(rr, {1.5, 0.5}, {0.5, 0.4});
  Vector still_q(2), still_dq(2), still_ddq(2);
  still_q << q[2], q[3];
  still_dq << dq[2], dq[3];
  still_ddq << ddq[2], ddq[3];
  Vector calm_dq = dq, calm_ddq = ddq;
  calm_dq[0] = calm_ddq[0] = 0.0;
  const Vector arm = inverse_dynamics(rr.chain, still_q, still_dq, still_ddq);
  const Vector whole = inverse_dynamics(rprr.chain, q, calm_dq, calm_ddq);
  EXPECT_NEAR(whole[2], arm[0], 1e-12);
  EXPECT_NEAR(whole[3], arm[1], 1e-12);
}

TEST(KnownArms, TipFollowsTheLinks) {
  Robot robot = preset_robot("RRP");
  robot = with_masses_and_lengths(robot, {1, 1, 1}, {0.5, 0.4, 0.0});
  Vector q(3);
  q << 0.3, 0.4, -0.2;
  const auto tip = tip_position(robot.chain, q);
  EXPECT_NEAR(tip.x(), 0.5 * std::cos(0.3) + 0.4 * std::cos(0.7), 1e-15);
  EXPECT_NEAR(tip.z(), -0.2, 1e-15);
  Robot single = preset_robot("R");
  single = with_masses_and_lengths(single, {1}, {0.5});
  EXPECT_NEAR(tip_position(single.chain, Vector(q.head(1))).y(), 0.5 * std::sin(0.3), 1e-15);
}

}  // namespace
}  // namespace faultline
