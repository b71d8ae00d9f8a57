// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "formats/open_log.hpp"
#include "lib/simulate/plant.hpp"
#include "tests/support/shared_data.hpp"

namespace faultline {
namespace {

/// A healthy, noise-free log of another simulator with the paper's robot and held torque: carrying each
/// logged state over one sample under the logged torque must land on the next. The log has seven digits.
TEST(IndependentSimulator, PlantReproducesItsHealthyLogWithHeldTorque) {
  const std::filesystem::path data = shared_data();
  if (data.empty()) return;
  const std::string path = (data / "independent-simulation" / "t_060.csv").string();
  if (!std::filesystem::exists(path)) {
    std::cout << path << " is absent, nothing checked\n";
    return;
  }
  const auto source = open_log(path);
  const Log log = read_all(*source);
  ASSERT_GT(log.rows(), 800);
  Robot robot = preset_robot("RRP");
  robot = with_masses_and_lengths(robot, {1.0, 0.8, 0.5}, {1.0, 0.8, 0.0});
  Plant plant(robot, {}, {}, 1e-3);
  JointVector tau(3);
  double worst = 0.0;
  for (int k = 0; k + 1 < log.rows(); ++k) {
    for (int i = 0; i < 3; ++i) {
      plant.q[i] = log.q[i][k];
      plant.dq[i] = log.dq[i][k];
      tau[i] = log.tau[i][k];
    }
    plant.advance(0.0, log.time[k + 1] - log.time[k], tau);
    for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(plant.q[i] - log.q[i][k + 1]));
  }
  EXPECT_LT(worst, 5e-6);
}

}  // namespace
}  // namespace faultline
