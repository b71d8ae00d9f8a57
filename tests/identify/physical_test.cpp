// SPDX-License-Identifier: MIT
#include "lib/identify/physical.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

namespace faultline {
namespace {

PhysicalFit solve(const Robot& nominal, KnownValue payload = {0.0, 0.0}, double carried = 0.0) {
  Robot truth = preset_robot("RRP");
  truth = with_masses_and_lengths(truth, {8.0, 5.0, 2.5}, {0.35, 0.3, 0.0});
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

TEST(PhysicalParameters, BaseParametersThatAreNaNGiveNoMass) {
  const Robot robot = preset_robot("RRP");
  const ParameterSpace space = parameter_space(robot);
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(space.count(), std::nan(""));
  const BaseEstimate estimate{
      none, Eigen::MatrixXd::Identity(none.size(), none.size()), std::vector<bool>(space.rigid(), true), {}};
  for (const auto& e : physical_parameters(robot, space, std::span(&estimate, 1)).parameters)
    EXPECT_FALSE(e.identifiable && std::isfinite(e.value)) << e.name;
}

TEST(PhysicalParameters, AMissingFactIsNamed) {
  const PhysicalFit fit = solve(preset_robot("RRP"));
  EXPECT_FALSE(fit.guessed_lengths.empty());
  for (const auto& e : fit.parameters) {
    if (e.name == "m3") continue;
    EXPECT_FALSE(e.identifiable) << e.name;
    EXPECT_TRUE(std::isnan(e.value)) << e.name;
    EXPECT_EQ(e.why_not, "give l1, l2, m1 or m2, or a second log with a known payload");
  }
}

TEST(PhysicalParameters, AnUnknownLengthIsGuessedFromPositiveMasses) {
  Robot nominal = preset_robot("RRP"), truth = nominal;
  nominal.known["l1"] = {0.35, 0.0};
  truth = with_masses_and_lengths(truth, {8.0, 5.0, 2.5}, {0.35, 0.3, 0.0});
  const ParameterSpace space = parameter_space(nominal);
  const Eigen::VectorXd p = parameters_of(space, truth.chain, 0.0);
  std::vector<bool> usable(space.rigid(), true);
  usable[3] = false;  // nobody knows m3
  const BaseEstimate estimate{p, Eigen::MatrixXd::Identity(p.size(), p.size()) * 1e-10, usable, {}};
  const PhysicalFit fit = physical_parameters(nominal, space, {&estimate, 1});
  ASSERT_EQ(fit.guessed_lengths.size(), 1u);
  EXPECT_EQ(fit.guessed_lengths[0].substr(0, 3), "l2 ");
  EXPECT_NEAR(fit.lengths[1] / 0.3, 1.0, 0.25);
  EXPECT_EQ(fit.lengths[0], 0.35);
}

TEST(PhysicalParameters, OneKnownLengthDeterminesAllMassesAndLengths) {
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

TEST(PhysicalParameters, AKnownPayloadDeterminesAllMassesAndLengths) {
  const PhysicalFit fit = solve(preset_robot("RRP"), {1.0, 0.0}, 1.0);
  const double truth[] = {8.0, 5.0, 2.5, 0.35, 0.3};
  ASSERT_EQ(fit.parameters.size(), 5u);
  for (int k = 0; k < 5; ++k) {
    EXPECT_TRUE(fit.parameters[k].identifiable) << fit.parameters[k].name;
    EXPECT_NEAR(fit.parameters[k].value / truth[k], 1.0, 1e-5) << fit.parameters[k].name;
  }
}

TEST(PhysicalParameters, AnUncertainPayloadIsWeighedByGravity) {
  const PhysicalFit fit = solve(preset_robot("RRP"), {1.3, 0.5}, 1.0);
  ASSERT_EQ(fit.parameters.size(), 5u);
  EXPECT_EQ(fit.parameters[3].name, "l1");
  EXPECT_TRUE(fit.parameters[3].identifiable);
  EXPECT_NEAR(fit.parameters[3].value, 0.35, 1e-3);
}

/// A planar arm in a vertical plane, known but for its masses and the second length; gravity tells more than
/// those need.
PhysicalFit solve_arm(double rotor_1, double relative_std) {
  Robot nominal = preset_robot("RR");
  nominal.chain.gravity = {0.0, -9.81, 0.0};
  Robot truth = nominal;
  truth = with_masses_and_lengths(truth, {4.0, 2.5}, {0.4, 0.35});
  truth.chain.rotor_inertia = {rotor_1, 0.0};
  nominal.known["l1"] = {0.4, 0.0};
  const ParameterSpace space = parameter_space(nominal);
  const Eigen::VectorXd p = parameters_of(space, truth.chain, 0.0);
  const Eigen::MatrixXd covariance = (relative_std * p).cwiseAbs2().asDiagonal();
  std::vector<bool> usable;
  for (int k = 0; k < space.rigid(); ++k) usable.push_back(!space.base[k].is_rotor);
  const std::vector<BaseEstimate> estimates = {{p, covariance, usable, {}}};
  return physical_parameters(nominal, space, estimates);
}

TEST(PhysicalParameters, LinksOfTheAssumedShapeGiveNoContradiction) {
  const PhysicalFit fit = solve_arm(0.0, 1e-3);
  EXPECT_LT(fit.contradiction, 1.1);
  EXPECT_TRUE(fit.hardly_identifiable.empty());
  EXPECT_NEAR(fit.parameters[1].value, 2.5, 1e-3);
}

TEST(PhysicalParameters, ARotorThatIsNotStatedWidensTheIntervalsToTheTruth) {
  const PhysicalFit fit = solve_arm(0.3, 1e-3);
  EXPECT_GT(fit.contradiction, 20.0);
  const double truth[] = {4.0, 2.5, 0.4, 0.35};
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const ParameterEstimate& e = fit.parameters[k];
    if (!e.identifiable) continue;
    EXPECT_TRUE(e.ci95[0] <= truth[k] && truth[k] <= e.ci95[1]) << e.name << " " << e.value;
  }
}

TEST(PhysicalParameters, AMassWhoseIntervalReachesZeroIsNotIdentifiable) {
  const PhysicalFit fit = solve_arm(0.0, 0.6);
  ASSERT_FALSE(fit.hardly_identifiable.empty());
  EXPECT_EQ(fit.hardly_identifiable.front(), "m1");
  EXPECT_FALSE(fit.parameters[0].identifiable);
  EXPECT_NE(fit.parameters[0].why_not.find("only to within"), std::string::npos);
}

}  // namespace
}  // namespace faultline
