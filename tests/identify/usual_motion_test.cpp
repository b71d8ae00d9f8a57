// SPDX-License-Identifier: MIT
#include "lib/identify/usual_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lib/core/error.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A vertical slide of 2 kg.
Chain slide() {
  Robot robot = preset_robot("P");
  robot = with_masses_and_lengths(robot, {2.0}, {0.0});
  robot.chain.friction = {{4.0, 0.3, 0.0, 0.01}};
  return robot.chain;
}

/// Speeds of 3 and -1 m/s in turn, torques of 6 and -8 N in turn, a range of 0.4 m.
Log alternating(int rows) {
  Log log;
  log.q = log.dq = log.tau = {{}};
  for (int k = 0; k < rows; ++k) {
    log.time.push_back(0.01 * k);
    log.q[0].push_back(k % 2 == 0 ? -0.1 : 0.3);
    log.dq[0].push_back(k % 2 == 0 ? 3.0 : -1.0);
    log.tau[0].push_back(k % 2 == 0 ? 6.0 : -8.0);
  }
  return log;
}

UsualMotion usual_in(const Log& log) {
  MemorySource source(log);
  return usual_motion(std::vector<LogSource*>{&source}, slide());
}

TEST(UsualMotion, IsTheRangeTheRmsOfTheSpeedAndTheLargestTorque) {
  const UsualMotion usual = usual_in(alternating(100));
  EXPECT_EQ(usual.q_low, std::vector<double>{-0.1});
  EXPECT_EQ(usual.q_high, std::vector<double>{0.3});
  EXPECT_DOUBLE_EQ(usual.velocity_scale[0], std::sqrt(5.0));
  EXPECT_EQ(usual.torque_scale, std::vector<double>{8.0});
}

TEST(UsualMotion, UsesTheChangeOfThePositionIfNoVelocityWasRecorded) {
  Log log = alternating(100);
  log.dq.clear();
  EXPECT_NEAR(usual_in(log).velocity_scale[0], 40.0, 1e-9) << "0.4 m in 10 ms";
}

TEST(UsualMotion, LeavesOutValuesThatAreMissing) {
  Log log = alternating(100);
  log.q[0][10] = log.dq[0][11] = log.tau[0][12] = kNaN;
  const UsualMotion usual = usual_in(log);
  EXPECT_EQ(usual.q_low, std::vector<double>{-0.1});
  EXPECT_EQ(usual.torque_scale, std::vector<double>{8.0});
  EXPECT_NEAR(usual.velocity_scale[0], std::sqrt(5.0), 0.05);
}

TEST(UsualMotion, RefusesLogsWithTooFewRows) {
  EXPECT_THROW(usual_in(alternating(49)), Error);
  EXPECT_NO_THROW(usual_in(alternating(50)));
}

TEST(UsualSizes, FollowFromRangeFrictionTorqueAndTheMassCarried) {
  const UsualMotion usual = usual_in(alternating(100));
  EXPECT_DOUBLE_EQ(feature_scale(usual, SizeMeasure::length, 0), 0.02 * 0.4);
  EXPECT_DOUBLE_EQ(feature_scale(usual, SizeMeasure::length_per_s, 0), 0.02 * 0.4);
  EXPECT_DOUBLE_EQ(feature_scale(usual, SizeMeasure::viscous_friction, 0), 4.0) << "its own friction";
  EXPECT_DOUBLE_EQ(feature_scale(usual, SizeMeasure::coulomb_friction, 0), 0.05 * std::sqrt(50.0))
      << "its own is less than a twentieth of the usual torque";
  EXPECT_DOUBLE_EQ(feature_scale(usual, SizeMeasure::torque, 0), 4.0);
  EXPECT_NEAR(feature_scale(usual, SizeMeasure::mass, 0), 1.0, 1e-9) << "half of what it carries";
  EXPECT_NEAR(usual_size(usual, SizeMeasure::mass, 0), 2.0, 1e-9);
  EXPECT_DOUBLE_EQ(usual_size(usual, SizeMeasure::length, 0), 0.4);
  EXPECT_DOUBLE_EQ(feature_scale(usual, SizeMeasure::impulse, 0), 8.0 * 0.05);
}

}  // namespace
}  // namespace faultline
