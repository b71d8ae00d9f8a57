// SPDX-License-Identifier: MIT
#include "lib/identify/physical.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

PhysicalFit solve(const Robot& nominal) {
  Robot truth = preset_robot("RRP");
  set_masses_and_lengths(truth, {8.0, 5.0, 2.5}, {0.35, 0.3, 0.0});
  const ParameterSpace space = parameter_space(nominal);
  const Eigen::VectorXd p = parameters_of(space, truth.chain, 0.0);
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(p.size(), p.size()) * 1e-10;
  return physical_parameters(nominal, space, p, covariance, std::vector<bool>(space.rigid(), true));
}

TEST(PhysicalParameters, WithoutAFactTheMissingOneIsNamed) {
  const PhysicalFit fit = solve(preset_robot("RRP"));
  EXPECT_FALSE(fit.lengths.has_value());
  for (const auto& e : fit.parameters) {
    if (e.name == "m3") continue;
    EXPECT_FALSE(e.identifiable) << e.name;
    EXPECT_TRUE(std::isnan(e.value)) << e.name;
    EXPECT_EQ(e.why_not, "give l1, l2, m1 or m2, or a second log with a known payload");
  }
}

TEST(PhysicalParameters, OneLengthClosesAllMassesAndLengths) {
  Robot robot = preset_robot("RRP");
  robot.known["l1"] = {0.35, 0.0};
  const PhysicalFit fit = solve(robot);
  const double truth[] = {8.0, 5.0, 2.5, 0.35, 0.3};
  ASSERT_EQ(fit.parameters.size(), 5u);
  for (int k = 0; k < 5; ++k) {
    EXPECT_TRUE(fit.parameters[k].identifiable);
    EXPECT_NEAR(fit.parameters[k].value / truth[k], 1.0, 1e-6) << fit.parameters[k].name;
  }
}

}  // namespace
}  // namespace faultline
