// SPDX-License-Identifier: MIT
#include "lib/identify/parameter_space.hpp"

#include <gtest/gtest.h>

#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

std::vector<std::string> names(const ParameterSpace& space) {
  std::vector<std::string> out;
  for (const auto& b : space.base) out.push_back(b.name);
  return out;
}

TEST(ParameterSpace, ScaraHasTheFourBaseParametersOfTheClosedForm) {
  const double m1 = 1.3, m2 = 0.8, m3 = 0.5, l1 = 0.9, l2 = 0.7;
  Robot nominal = preset_robot("RRP"), truth = nominal;
  truth = with_masses_and_lengths(truth, {m1, m2, m3}, {l1, l2, 0.0});
  const ParameterSpace space = parameter_space(nominal);
  EXPECT_EQ(names(space), (std::vector<std::string>{"a", "b", "c", "m3", "jr2", "jr3"}));
  const auto p = parameters_of(space, truth.chain, 0.0);
  EXPECT_NEAR(p[0], l1 * l1 * (m1 / 3 + m2 + m3), 1e-12);
  EXPECT_NEAR(p[1], l2 * l2 * (m2 / 3 + m3), 1e-12);
  EXPECT_NEAR(p[2], l1 * l2 * (m2 / 2 + m3), 1e-12);
  EXPECT_NEAR(p[3], m3, 1e-12);
}

TEST(ParameterSpace, NominalLengthsReproduceTheTorquesOfTheRealScara) {
  Robot nominal = preset_robot("RRP"), truth = nominal;
  truth = with_masses_and_lengths(truth, {1.3, 0.8, 0.5}, {0.9, 0.7, 0.0});
  const ParameterSpace space = parameter_space(nominal);
  const Chain chain = chain_from(space, parameters_of(space, truth.chain, 0.0));
  JointVector q(3), dq(3), ddq(3);
  q << 0.3, -1.2, 0.1;
  dq << 1.0, 2.0, -0.5;
  ddq << -3.0, 1.0, 2.0;
  EXPECT_LT((inverse_dynamics(chain, q, dq, ddq) - inverse_dynamics(truth.chain, q, dq, ddq)).norm(), 1e-11);
}

TEST(ParameterSpace, VerticalDoublePendulumHasItsGravityMoments) {
  Robot robot = preset_robot("RR");
  robot.chain.gravity = {9.81, 0.0, 0.0};
  const ParameterSpace space = parameter_space(robot);
  EXPECT_EQ(names(space), (std::vector<std::string>{"I1", "mx1", "I2", "mx2", "jr2"}));
  EXPECT_EQ(space.base[0].meaning, "I1 + m2 + jr1");
}

TEST(ParameterSpace, RotorsThatActSeparatelyFromTheLinksAreBaseParameters) {
  Robot nominal = preset_robot("RRP"), truth = nominal;
  truth = with_masses_and_lengths(truth, {1.3, 0.8, 0.5}, {0.9, 0.7, 0.0});
  truth.chain.rotor_inertia = {0.3, 0.02, 0.1};
  const ParameterSpace space = parameter_space(nominal);
  const auto p = parameters_of(space, truth.chain, 0.0);
  EXPECT_NEAR(p[4], 0.02, 1e-12);
  EXPECT_NEAR(p[5], 0.1, 1e-12);
  const Chain chain = chain_from(space, p);
  JointVector q(3), dq(3), ddq(3);
  q << 0.3, -1.2, 0.1;
  dq << 1.0, 2.0, -0.5;
  ddq << -3.0, 1.0, 2.0;
  EXPECT_LT((inverse_dynamics(chain, q, dq, ddq) - inverse_dynamics(truth.chain, q, dq, ddq)).norm(), 1e-11);
}

TEST(ParameterSpace, OneSlidingAxisHasOneMass) {
  Robot robot = preset_robot("P");
  robot.chain.gravity.setZero();
  EXPECT_EQ(names(parameter_space(robot)), (std::vector<std::string>{"m1"}));
}

TEST(ParameterSpace, AFourthAxisAddsTheInertiaOfTheTool) {
  const auto all = names(parameter_space(preset_robot("RRPR")));
  ASSERT_GE(all.size(), 5u);
  EXPECT_EQ(all[3], "m3");
  EXPECT_EQ(all[4], "Izz4");
}

}  // namespace
}  // namespace faultline
