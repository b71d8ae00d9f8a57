// SPDX-License-Identifier: MIT
// Robots whose controller commands more torque than the drive gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/diagnose/diagnose.hpp"
#include "lib/learn/healthy_robot.hpp"
#include "tests/learn/small_robot.hpp"

namespace faultline {
namespace {

/// A rod that turns about the vertical, with friction.
Robot rod() {
  Robot robot = preset_robot("R");
  robot = with_masses_and_lengths(robot, {4.0}, {0.6});
  robot.chain.friction = {{0.4, 0.6, 0.0, 0.02}};
  robot.name = "rod";
  robot.log.torque_between_samples = TorqueTiming::held;
  return robot;
}

/// What its user knows of it.
Robot unknown_rod() {
  Robot robot = preset_robot("R");
  robot.name = "rod";
  robot.log.torque_between_samples = TorqueTiming::held;
  return robot;
}

/// A day on which the drive gives at most `share` of the largest torque that the motion needs.
SimulationSpec limited_run(double duration_s, double share) {
  SimulationSpec spec = small_run(duration_s);
  double largest = 0.0;
  const Log free = simulate(rod(), spec, 91).log;
  for (const double torque : free.tau[0]) largest = std::max(largest, std::abs(torque));
  spec.drives.limit = {share * largest};
  return spec;
}

Learned learned_with(const SimulationSpec& spec) {
  MemorySource first(simulate(rod(), spec, 91).log, "a.csv"), second(simulate(rod(), spec, 92).log, "b.csv");
  std::vector<LogSource*> logs = {&first, &second};
  return learn(logs, {}, unknown_rod(), quick_learning());
}

/// Diagnoses the log as it is opened for the robot of the model: cut to the limits of the drives.
Diagnosis diagnosed(const Learned& learned, Log log) {
  MemorySource source(std::move(log), "run.csv");
  ConvertedTorqueSource opened(source, {{}, {}, learned.model.robot.torque_limit});
  return diagnose(opened, learned.model, learned.cases, {});
}

TEST(DriveLimits, AreLearnedAndACommandBeyondThemIsNoFault) {
  SimulationSpec spec = limited_run(30.0, 0.7);
  const Learned learned = learned_with(spec);
  const Issues& issues = learned.identification.issues;
  EXPECT_EQ(learned.identification.status, IdentificationStatus::converged);
  ASSERT_EQ(learned.model.robot.torque_limit.size(), 1u);
  EXPECT_NEAR(learned.model.robot.torque_limit[0] / spec.drives.limit[0], 1.0, 0.05);
  EXPECT_NE(issues.find("drive_limit", "tau1"), nullptr);
  EXPECT_EQ(issues.find("torque_limit", "tau1"), nullptr) << "no cause for doubt: it is known";

  const Diagnosis healthy = diagnosed(learned, simulate(rod(), spec, 93).log);
  EXPECT_EQ(healthy.verdict, Verdict::healthy) << healthy.verdict_reason;
  EXPECT_TRUE(std::ranges::any_of(healthy.cannot_see, [](const std::string& spot) {
    return spot.find("more is commanded than the drive of joint 1 gives") != std::string::npos;
  }));

  spec.faults = {{FaultKind::torque_loss, 1_joint, 14.0, std::numeric_limits<double>::infinity(), 0.3, 0.0}};
  const Diagnosis lost = diagnosed(learned, simulate(rod(), spec, 94).log);
  ASSERT_FALSE(lost.faults.empty());
  EXPECT_NEAR(lost.faults.front().onset_s, 14.0, 0.3);
}

TEST(DriveLimits, ADriveThatGivesAllTorqueHasNone) {
  const SimulationSpec spec = limited_run(20.0, 1.5);
  MemorySource first(simulate(rod(), spec, 91).log, "a.csv"), second(simulate(rod(), spec, 92).log, "b.csv");
  const std::vector<LogSource*> logs = {&first, &second};
  const HealthyRobot robot = healthy_robot(logs, unknown_rod(), {}, {});
  EXPECT_TRUE(robot.model.robot.torque_limit.empty());
  EXPECT_EQ(robot.identification.issues.find("drive_limit", "tau1"), nullptr);
}

}  // namespace
}  // namespace faultline
