// SPDX-License-Identifier: MIT
#include "lib/wear/twins.hpp"

#include <gtest/gtest.h>

#include "lib/core/error.hpp"
#include "lib/core/random.hpp"

namespace faultline {
namespace {

std::vector<TwinMember> members(const std::vector<double>& values) {
  std::vector<TwinMember> made;
  for (const double value : values) made.push_back({"robot " + std::to_string(made.size()), value, 0.1});
  return made;
}

/// One robot with a constant condition of these joints over six logs.
RobotWear robot(const std::string& name, const std::vector<double>& friction) {
  std::vector<WearLog> logs;
  for (int i = 0; i < 6; ++i) {
    WearLog log{name + std::to_string(i), 0.0, {}};
    for (std::size_t j = 0; j < friction.size(); ++j)
      log.condition.push_back(
          {"friction_" + std::to_string(j + 1), friction[j] + (i % 2 ? 0.1 : -0.1), 0.3, "%"});
    logs.push_back(log);
  }
  return robot_wear(name, name, logs);
}

TEST(TwinOutliers, EqualMembersKeepTheStatedRateOfFalseAlarms) {
  Random random(5);
  constexpr int kGroups = 4000;
  for (const int size : {4, 6, 12}) {
    int found = 0;
    for (int i = 0; i < kGroups; ++i) {
      std::vector<double> values;
      for (int k = 0; k < size; ++k) values.push_back(3.0 * random.normal());
      found += !twin_outliers(members(values), 0.05).empty();
    }
    EXPECT_LE(found, 0.06 * kGroups) << size;
    EXPECT_GE(found, 0.02 * kGroups) << size << ": the bound is no looser than needed";
  }
}

TEST(TwinOutliers, TheOneThatDiffersIsFoundWithTheSpreadOfTheOthers) {
  const auto outliers = twin_outliers(members({1.0, -1.0, 0.5, -0.5, 0.0, 20.0}), 0.01);
  ASSERT_EQ(outliers.size(), 1u);
  EXPECT_EQ(outliers[0].member, 5u);
  EXPECT_DOUBLE_EQ(outliers[0].difference, 20.0);
  EXPECT_NEAR(outliers[0].spread, 0.79, 0.01);
}

TEST(TwinOutliers, ThreeMembersAreTooFew) {
  EXPECT_TRUE(twin_outliers(members({0.0, 0.1, 1000.0}), 0.05).empty());
}

TEST(TwinOutliers, TheUncertaintyOfTheMembersIsTheLeastSpread) {
  std::vector<TwinMember> same = members({1.0, 1.0, 1.0, 1.0, 1.0, 1.2});
  EXPECT_TRUE(twin_outliers(same, 0.01).empty());
}

TEST(CompareRobots, NamesTheRobotWhoseFrictionDiffers) {
  const TwinReport report =
      compare_robots({robot("a", {1, 0}), robot("b", {-1, 1}), robot("c", {18, -1}), robot("d", {0, 0.5}),
                      robot("e", {0.5, 0}), robot("f", {-0.5, 0})});
  EXPECT_EQ(report.not_applicable, "");
  EXPECT_NE(
      to_text(report).find("stands out: friction of joint 1: c is +18 % beside the mean of the 5 others"),
      std::string::npos)
      << to_text(report);
  EXPECT_EQ(to_text(report).find("joint 2"), std::string::npos);
}

TEST(CompareRobots, ThreeRobotsAreNotCompared) {
  const TwinReport report = compare_robots({robot("a", {1}), robot("b", {2}), robot("c", {30})});
  EXPECT_EQ(report.not_applicable, "3 robots with the same item of the condition, 4 are needed");
  EXPECT_NE(twins_html(report).find("Not applicable"), std::string::npos);
}

TEST(CompareJoints, NamesThePairThatDiffers) {
  const std::vector<JointPair> pairs = joint_pairs("1:2,3:4", "--twins");
  const TwinReport report = compare_joints(
      {robot("a", {20, 1, 5, 5.2}), robot("b", {1, 1.3, 0, 0}), robot("c", {0, -0.3, 7, 7.4})}, pairs);
  const std::string text = to_text(report);
  EXPECT_NE(text.find("friction of pairs of joints: a, joint 1 minus joint 2 is +19"), std::string::npos)
      << text;
}

TEST(JointPairs, AreParsedAndOtherTextIsRefused) {
  EXPECT_EQ(joint_pairs("", "--twins").size(), 0u);
  EXPECT_EQ(joint_pairs("1:4,2:5", "--twins")[1], (JointPair{2_joint, 5_joint}));
  for (const char* wrong : {"1-4", "1:1", "0:2", "1:4;2:5", "1:999", ","})
    EXPECT_THROW(joint_pairs(wrong, "--twins"), Error) << wrong;
}

}  // namespace
}  // namespace faultline
