// SPDX-License-Identifier: MIT
#include "lib/robot/payload.hpp"

#include <gtest/gtest.h>

#include "lib/robot/dynamics.hpp"
#include "tests/robot/assorted_chains.hpp"
#include "tests/support/chain_mechanics.hpp"

namespace faultline {
namespace {

using Links = std::vector<Joint>;

TEST(Payload, AddsTheForceThatItsWeightAndAccelerationTakeAtItsPlace) {
  const Chain chain = preset_robot("RR").chain;  // in a horizontal plane, links of 1 m
  const Chain loaded = with_payload(chain, 0, 2.0);
  JointVector q(2), dq(2), ddq(2);
  q << 0.3, -0.8;
  dq << 0.5, 1.0;
  ddq << 4.0, -1.0;
  const JointVector more = inverse_dynamics(loaded, q, dq, ddq) - inverse_dynamics(chain, q, dq, ddq);
  EXPECT_NEAR(more[0], 2.0 * chain.length[0] * chain.length[0] * 4.0, 1e-9);
  EXPECT_NEAR(more[1], 0.0, 1e-12) << "the second joint does not move the first link";
}

TEST(Payload, OfTheLastLinkIsAtTheTip) {
  Random random(5);
  for (const Chain& chain : assorted_chains()) {
    const int n = chain.joints();
    const JointVector q = draw(random, n, 1.0), still = JointVector::Zero(n);
    const JointVector weight = inverse_dynamics(with_payload(chain, n - 1, 1.0), q, still, still) -
                               inverse_dynamics(chain, q, still, still);
    for (int j = 0; j < n; ++j) {  // the torque of a weight is how the tip moves against gravity
      const double step = 1e-6;
      JointVector on = q, back = q;
      on[j] += step;
      back[j] -= step;
      const Eigen::Vector3d slope = (tip_position(chain, on) - tip_position(chain, back)) / (2.0 * step);
      EXPECT_NEAR(weight[j], -chain.gravity.dot(slope), 1e-6) << "joint " << j + 1;
    }
  }
}

TEST(PayloadLinks, AreAllLinksOfAScara) {
  EXPECT_EQ(payload_links(preset_robot("RRP").chain), (Links{1_joint, 2_joint, 3_joint}));
}

TEST(PayloadLinks, IncludeOnlyTheLaterOfTwoLinksThatEndAtOnePoint) {
  Chain chain = preset_robot("RRR").chain;
  chain.geometry[2].axis = Eigen::Vector3d::UnitX();
  chain.length[2] = 0.0;  // the tip stays where joint 3 is
  EXPECT_EQ(payload_links(chain), (Links{1_joint, 3_joint}));
}

TEST(PayloadLinks, ExcludeALinkThatEndsOnItsAxis) {
  Chain chain = preset_robot("RRP").chain;
  chain.length[0] = 0.0;
  chain.geometry[1].axis = Eigen::Vector3d::UnitY();
  chain.geometry[1].offset = {0.0, 0.0, 0.4};  // above the first joint
  EXPECT_EQ(payload_links(chain), (Links{2_joint, 3_joint}));
}

}  // namespace
}  // namespace faultline
