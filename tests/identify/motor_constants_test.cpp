// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/robot_file.hpp"
#include "lib/simulate/simulate.hpp"

namespace faultline {
namespace {

/// An upright arm with a base that turns about the vertical axis, a shoulder, an elbow and a wrist that turns
/// about its own link. `torque`: the meaning of the torque column.
std::string arm_text(const std::string& torque, bool with_masses) {
  std::string text = "gravity = [0, 0, -9.81]\n";
  if (with_masses) text += "friction = {viscous = [4, 5, 2, 0.5], coulomb = [5, 6, 3, 0.6], width = 0.02}\n";
  text += "[log]\ntorque = \"" + torque + "\"\ntorque_between_samples = \"held\"\n";
  for (const char* joint :
       {"axis = [0, 0, 1]\noffset = [0, 0, 0]", "axis = [0, 1, 0]\noffset = [0, 0, 0.3]",
        "axis = [0, 1, 0]\noffset = [0, 0, 0.4]", "axis = [0, 0, 1]\noffset = [0, 0, 0.2]"})
    text += std::string("[[joint]]\nkind = \"revolute\"\n") + joint + "\n";
  const char* const links[] = {"mass = 8\ncentre = [0, 0, 0.1]\ninertia = [0.05, 0.05, 0.04]",
                               "mass = 9\ncentre = [0, 0.03, 0.2]\ninertia = [0.09, 0.09, 0.02]",
                               "mass = 5\ncentre = [0.01, 0, 0.1]\ninertia = [0.03, 0.03, 0.01]",
                               "mass = 2\ncentre = [0.06, 0.01, 0.1]\ninertia = [0.01, 0.01, 0.01]"};
  for (const char* link : links)
    text += std::string("[[link]]\nshape = \"general\"\n") + (with_masses ? link : "") + "\n";
  return text;
}

/// Logs of the arm on days with other friction, whose drives miss a share of the torque; column j is the
/// torque times current_per_torque[j].
std::vector<Log> logs_in_amperes(const std::vector<double>& current_per_torque, std::uint64_t seed) {
  std::vector<Log> out;
  for (int day = 0; day < 2; ++day) {
    Robot robot = robot_from_toml(arm_text("commanded", true), "arm.toml");
    for (Friction& friction : robot.chain.friction) friction.coulomb *= day == 0 ? 1.0 : 1.15;
    SimulationSpec spec;
    spec.duration_s = 20.0;
    spec.sample_period_s = spec.control_period_s = 0.004;
    spec.motion.low = {-1.5, -1.2, -1.5, -1.8};
    spec.motion.high = {1.5, 1.2, 1.5, 1.8};
    spec.noise.q.assign(4, 3e-5);
    spec.noise.dq.assign(4, 2e-3);
    spec.drives.roughness = {0.6, 0.6, 0.4, 0.05};
    spec.drives.roughness_memory_s.assign(4, 0.05);
    Log log = simulate(robot, spec, seed + static_cast<std::uint64_t>(day)).log;
    for (std::size_t j = 0; j < current_per_torque.size(); ++j)
      for (double& value : log.tau[j]) value *= current_per_torque[j];
    out.push_back(std::move(log));
  }
  return out;
}

Identification identified(const std::vector<Log>& logs, const std::string& meaning) {
  std::vector<std::unique_ptr<MemorySource>> sources;
  std::vector<LogSource*> all;
  for (const Log& log : logs)
    all.push_back(sources.emplace_back(std::make_unique<MemorySource>(log, "log")).get());
  return identify(all, robot_from_toml(arm_text(meaning, false), "arm.toml"));
}

TEST(MotorConstants, RatiosAndSignsOfCurrentsFollowFromTheMassesThatJointsShare) {
  const std::vector<std::vector<double>> cases = {{0.1, -0.1, 0.25, -0.2}, {-0.1, -0.2, -0.3, -0.4}};
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Identification id = identified(logs_in_amperes(cases[k], 10 * k + 3), "current");
    ASSERT_EQ(id.robot.torque_gain.size(), 4u) << k;
    const auto constant = [&](int j) {
      return id.robot.torque_gain[j] * cases[k][j];
    };  // all alike, positive
    EXPECT_GT(constant(1), 0.0) << k;
    for (const int j : {0, 2, 3})
      EXPECT_NEAR(constant(j) / constant(1), 1.0, j == 2 ? 0.05 : 0.15) << k << " " << j;
    for (const double r2 : id.fit_r2) EXPECT_GT(r2, 0.97) << k;
    EXPECT_TRUE(id.issues.find("motor_constants")) << k;
  }
}

TEST(MotorConstants, CurrentsOfEqualConstantsStayAsTheyAre) {
  const Identification id = identified(logs_in_amperes({0.1, 0.1, 0.1, 0.1}, 5), "current");
  EXPECT_FALSE(id.issues.find("motor_constants"));
  EXPECT_TRUE(id.robot.torque_gain.empty());
}

TEST(Reinterpretation, TorquesThatAllCountAgainstTheAxesAreNamed) {
  const Identification id = identified(logs_in_amperes({-1.0, -1.0, -1.0, -1.0}, 5), "commanded");
  const Issue* misread = id.issues.find("misread_columns");
  ASSERT_TRUE(misread);
  EXPECT_NE(misread->message.find("all torques have the opposite sign"), std::string::npos)
      << misread->message;
}

TEST(MotorConstants, ACommandedTorqueOfTheWrongSignIsNotTurned) {
  const Identification id = identified(logs_in_amperes({1.0, -1.0, 1.0, 1.0}, 5), "commanded");
  EXPECT_FALSE(id.issues.find("motor_constants"));
  EXPECT_EQ(id.status, IdentificationStatus::unexplained);
}

}  // namespace
}  // namespace faultline
