// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <iostream>

#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "tests/identify/shared_data.hpp"

namespace faultline {
namespace {

/// A real planar arm in a vertical plane that hangs at q = 0, motor torque measured, noisy velocity.
Robot double_pendulum(double l1) {
  Robot robot = preset_robot("RR");
  robot.chain.gravity = {9.81, 0.0, 0.0};
  robot.known["l1"] = {l1, 0.0};
  robot.chain.length[0] = l1;
  robot.log.torque = TorqueMeaning::measured;
  return robot;
}

Identification identify_excitation(const std::string& folder, double until_s) {
  Log log = testing::read_plain_csv(folder + "/double-pendulum/both_joints_75s.csv", {1, 2}, {3, 4}, {5, 6});
  int rows = 0;
  while (rows < log.rows() && log.time[rows] < until_s) ++rows;
  MemorySource source(slice(log, 0, rows), "excitation");
  LogSource* logs[] = {&source};
  return identify(logs, double_pendulum(0.3));
}

/// From undisturbed runs of that arm and these numbers, with the torque that was commanded.
Identification identify_undisturbed(const std::string& folder, const std::string& arm,
                                    const std::vector<std::string>& numbers, const Robot& robot) {
  std::vector<MemorySource> sources;
  for (const std::string& number : numbers)
    sources.emplace_back(
        testing::read_plain_csv(folder + "/double-pendulum/" + arm + "_undisturbed_" + number + ".csv",
                                {1, 2}, {3, 4}, {9, 10}),
        number);
  std::vector<LogSource*> logs;
  for (MemorySource& source : sources) logs.push_back(&source);
  return identify(logs, robot);
}

TEST(IdentifyRealArm, NoisyVelocityDoesNotHideTheInertia) {
  const std::string folder = testing::shared_data();
  if (folder.empty()) return;
  const Identification id = identify_excitation(folder, 50.0);
  for (std::size_t j = 0; j < 2; ++j)
    std::cout << "joint " << j + 1 << " R2 " << id.fit_r2[j] << ", held out " << id.held_out_r2[j] << ", "
              << 1e3 * id.torque_delay_s[j] << " ms late\n";
  EXPECT_EQ(id.status, IdentificationStatus::converged) << id.reason;
  EXPECT_GE(id.held_out_r2[0], 0.997);
  EXPECT_GE(id.held_out_r2[1], 0.994);
  for (const double delay : id.torque_delay_s) {
    EXPECT_GE(delay, 0.005);
    EXPECT_LE(delay, 0.012);
  }
}

TEST(IdentifyRealArm, AnUndrivenJointGivesPlausibleParameters) {
  const std::string folder = testing::shared_data();
  if (folder.empty()) return;
  const Identification id =
      identify_undisturbed(folder, "pendubot", {"01", "02", "05"}, double_pendulum(0.2));
  for (const ParameterEstimate& e : id.physical_parameters) {
    std::cout << e.name << " " << e.value << " +- " << e.std << " " << e.why_not << "\n";
    if (!e.identifiable || e.std == 0.0) continue;
    EXPECT_GT(e.value, 1e-3) << e.name;
    EXPECT_LT(e.value, 100.0) << e.name;
  }
  std::cout << to_string(id.status) << "; " << id.reason << "\n";
}

TEST(IdentifyRealArm, WindowsOfEachJointAreLongEnoughForTheOther) {
  const std::string folder = testing::shared_data();
  if (folder.empty()) return;
  Robot robot = double_pendulum(0.2);
  robot.log.torque = TorqueMeaning::commanded;
  const Identification id =
      identify_undisturbed(folder, "acrobot", {"01", "02", "05", "06", "07", "08"}, robot);
  EXPECT_GE(id.held_out_r2[0], 0.9);
  EXPECT_GE(id.held_out_r2[1], 0.99);
}

}  // namespace
}  // namespace faultline
