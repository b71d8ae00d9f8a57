// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/fit_verdict.hpp"

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>

namespace faultline {
namespace {

/// A SCARA whose joint 2 was seen between 1.2 and 1.9 rad, with these values of its base parameters.
Identification scara(const std::map<std::string, double>& values, double std) {
  Identification id;
  id.status = IdentificationStatus::converged;
  id.robot = preset_robot("RRP");
  id.space = parameter_space(id.robot);
  id.estimate = Eigen::VectorXd::Zero(id.space.count());
  id.covariance = Eigen::MatrixXd::Zero(id.space.count(), id.space.count());
  for (int p = 0; p < id.space.rigid(); ++p) {
    const auto given = values.find(id.space.name(p));
    if (given == values.end()) continue;
    id.estimate[p] = given->second;
    id.covariance(p, p) = std * std;
  }
  id.joint_fits.resize(3);
  id.joint_fits[0].q = {-0.3, 0.3};
  id.joint_fits[1].q = {1.2, 1.9};
  id.joint_fits[2].q = {-0.3, 0.0};
  return id;
}

TEST(InertiaVerdict, ARobotWithPositiveInertiaIsAccepted) {
  const Identification id = scara({{"a", 1.6}, {"b", 0.5}, {"c", 0.7}, {"m3", 0.5}}, 0.01);
  EXPECT_FALSE(negative_inertia(id).has_value());
}

TEST(InertiaVerdict, ANegativeInertiaInTheRangeOfTheLogsIsRejected) {
  const Identification id = scara({{"a", -136.0}, {"b", 0.5}, {"c", 0.7}, {"m3", 0.5}}, 1.0);
  const std::optional<FitStatus> found = negative_inertia(id);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->status, IdentificationStatus::unexplained);
  EXPECT_EQ(found->reason.find("the inertia of joint 1 was estimated as -13"), 0u) << found->reason;
  EXPECT_NE(found->reason.find("revolutions"), std::string::npos) << found->reason;
}

TEST(InertiaVerdict, ASurelyNegativeInertiaBeyondThePositionsOfTheLogsIsRejected) {
  const std::map<std::string, double> turns = {{"a", 10.0}, {"b", 8.0}, {"c", 11.0}, {"m3", 0.5}};
  const std::optional<FitStatus> sure = negative_inertia(scara(turns, 0.1));
  ASSERT_TRUE(sure.has_value());
  EXPECT_EQ(sure->status, IdentificationStatus::unexplained);
  EXPECT_FALSE(negative_inertia(scara(turns, 10.0)).has_value()) << "the logs hardly tell it";
}

}  // namespace
}  // namespace faultline
