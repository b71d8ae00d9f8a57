// SPDX-License-Identifier: MIT
#include "lib/diagnose/least_size.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

/// A slide that carries 2 kg, with at most 10 N and 0.5 m of way.
Model slide(const std::string& more = "") {
  Model model;
  model.robot = robot_from_toml("name = \"slide\"\naxes = \"P\"\n" + more, "robot");
  model.motion.sizes.bias = model.motion.sizes.drift = {0.01};
  model.motion.sizes.viscous_increase = model.motion.sizes.coulomb_increase = {1.0};
  model.motion.sizes.external_torque = {5.0};
  model.motion.sizes.payload = 1.0;
  model.motion.q_low = {0.0};
  model.motion.q_high = {0.5};
  model.motion.torque_scale = {10.0};
  model.labels = fault_labels(1, {1_joint}, false);
  return model;
}

FaultExtent of_payload(double kg, const Model& model) {
  const FaultLabel label{FaultKind::payload_change, 1_joint};
  return extent_of(label, {{label, 50.0, {kg / model.motion.sizes.payload, 0.0}}}, model);
}

TEST(LeastSize, IsAShareOfTheMassThatTheRobotCarries) {
  const FaultExtent gram = of_payload(0.0014, slide());
  EXPECT_NEAR(gram.size, 0.0014, 1e-12);
  EXPECT_NEAR(gram.least_size, 0.03 * 2.0, 1e-12);
  EXPECT_EQ(gram.unit, "kg");
  EXPECT_LT(gram.times_least, 1.0);
  EXPECT_GE(of_payload(-0.07, slide()).times_least, 1.0);
}

TEST(LeastSize, IsSetInTheRobotFileAndZeroReportsEverySize) {
  EXPECT_NEAR(of_payload(0.1, slide("[least_size]\npayload_change = 0.2\n")).least_size, 0.4, 1e-12);
  EXPECT_GE(of_payload(1e-9, slide("[least_size]\npayload_change = 0\n")).times_least, 1.0);
}

TEST(LeastSize, IsKeptWhenTheRobotFileIsWritten) {
  const Robot robot = slide("[least_size]\npayload_change = 0.2\nsensor_bias = 0.01\n").robot;
  EXPECT_EQ(robot_from_toml(robot_file_text(robot), "written").least_sizes, robot.least_sizes);
  EXPECT_EQ(robot_file_text(slide().robot).find("least_size"), std::string::npos);
}

TEST(LeastSize, ANegativeShareOrAKindWithoutSizeIsRefused) {
  EXPECT_THROW(slide("[least_size]\npayload_change = -0.1\n"), Error);
  EXPECT_THROW(slide("[least_size]\nlocked = 0.1\n"), Error);
}

TEST(LeastSize, IsStatedForEachKindAndJoint) {
  const std::vector<std::string> sentences = least_size_sentences(slide());
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_NE(sentences[0].find("changed payload: joint 1 0.06 kg"), std::string::npos) << sentences[0];
  EXPECT_NE(sentences[0].find("loss of torque: joint 1 3 %"), std::string::npos) << sentences[0];
}

TEST(LeastSize, IsUndefinedForAKindWithoutSize) {
  const FaultLabel locked{FaultKind::locked, 1_joint};
  EXPECT_TRUE(std::isnan(extent_of(locked, {{locked, 50.0}}, slide()).times_least));
}

}  // namespace
}  // namespace faultline
