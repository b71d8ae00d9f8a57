// SPDX-License-Identifier: MIT
#include "lib/identify/physical.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

PhysicalFit solve(const Robot& nominal, KnownValue payload = {0.0, 0.0}, double carried = 0.0) {
  Robot truth = preset_robot("RRP");
  set_masses_and_lengths(truth, {8.0, 5.0, 2.5}, {0.35, 0.3, 0.0});
  const ParameterSpace space = parameter_space(nominal);
  const Eigen::VectorXd p = parameters_of(space, truth.chain, 0.0);
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(p.size(), p.size()) * 1e-10;
  std::vector<BaseEstimate> estimates = {{p, covariance, std::vector<bool>(space.rigid(), true), {}}};
  if (payload.value > 0.0) {  // da = l1^2 dm, db = l2^2 dm, dc = l1 l2 dm, dm3 = dm
    estimates.push_back(estimates[0]);
    estimates[1].payload = payload;
    estimates[1].estimate.head(4) += carried * Eigen::Vector4d(0.35 * 0.35, 0.3 * 0.3, 0.35 * 0.3, 1.0);
  }
  return physical_parameters(nominal, space, estimates);
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

TEST(PhysicalParameters, AKnownPayloadClosesAllMassesAndLengths) {
  const PhysicalFit fit = solve(preset_robot("RRP"), {1.0, 0.0}, 1.0);
  const double truth[] = {8.0, 5.0, 2.5, 0.35, 0.3};
  ASSERT_EQ(fit.parameters.size(), 5u);
  for (int k = 0; k < 5; ++k) {
    EXPECT_TRUE(fit.parameters[k].identifiable) << fit.parameters[k].name;
    EXPECT_NEAR(fit.parameters[k].value / truth[k], 1.0, 1e-5) << fit.parameters[k].name;
  }
}

TEST(PhysicalParameters, ADoubtfulPayloadIsWeighedByGravity) {
  const PhysicalFit fit = solve(preset_robot("RRP"), {1.3, 0.5}, 1.0);
  ASSERT_EQ(fit.parameters.size(), 5u);
  EXPECT_EQ(fit.parameters[3].name, "l1");
  EXPECT_TRUE(fit.parameters[3].identifiable);
  EXPECT_NEAR(fit.parameters[3].value, 0.35, 1e-3);
}

}  // namespace
}  // namespace faultline
