// SPDX-License-Identifier: MIT
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lib/robot/dynamics.hpp"
#include "tests/robot/assorted_chains.hpp"

namespace faultline {
namespace {

using Vector = JointVector<double>;

TEST(ChainJets, GiveTheDerivativesOfDifferences) {
  using Jet = ceres::Jet<double, 3>;
  Random random(29);
  Chain<double> chain = crossed_wrist(random);
  for (auto& f : chain.friction) f = {0.4, 0.7, 0.1, 0.3};
  const Vector q = draw(random, 3, 1.0), dq = draw(random, 3, 1.0), tau = draw(random, 3, 5.0);
  const Chain<Jet> jets = cast_chain<Jet>(chain);
  JointVector<Jet> q_jet(3), dq_jet(3), tau_jet(3);
  for (int i = 0; i < 3; ++i) {
    q_jet[i] = Jet(q[i], i);
    dq_jet[i] = Jet(dq[i]);
    tau_jet[i] = Jet(tau[i]);
  }
  const auto ddq = forward_dynamics(jets, q_jet, dq_jet, tau_jet);
  for (int k = 0; k < 3; ++k) {
    Vector low = q, high = q;
    low[k] -= 1e-6;
    high[k] += 1e-6;
    const Vector slope =
        (forward_dynamics(chain, high, dq, tau) - forward_dynamics(chain, low, dq, tau)) / 2e-6;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(ddq[i].v[k], slope[i], 1e-6 * (1.0 + std::abs(slope[i])));
  }
}

TEST(ChainJets, RunThroughTheParameters) {
  using Jet = ceres::Jet<double, 1>;
  const Robot robot = preset_robot("RRP");
  Chain<Jet> chain = cast_chain<Jet>(robot.chain);
  chain.links[2].mass = Jet(1.0, 0);
  JointVector<Jet> q(3), zero(3);
  q << Jet(0.1), Jet(0.2), Jet(-0.1);
  zero << Jet(0.0), Jet(0.0), Jet(0.0);
  EXPECT_NEAR(gravity_torque(chain, q)[2].v[0], 9.81, 1e-12);
  EXPECT_NEAR(inertia_matrix(chain, q)(2, 2).v[0], 1.0, 1e-12);
}

}  // namespace
}  // namespace faultline
