// SPDX-License-Identifier: MIT
// A robot at a coarse rate whose friction and torque constants differ by day, in closed form.
#include "lib/identify/days/fit_coarse_days.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/log/log_source.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

constexpr double kPeriod_s = 0.025;

OneStepModel fitted(const std::vector<double>& friction) {
  std::vector<MemorySource> sources;
  for (std::size_t day = 0; day < friction.size(); ++day) {
    testing::ClosedFormScara robot;
    for (int j = 0; j < 3; ++j) robot.fc[j] *= friction[day], robot.fv[j] *= friction[day];
    const testing::ClosedFormRun run{.duration_s = 10.0,
                                     .period_s = kPeriod_s,
                                     .reach = {0.8, 0.9, 0.1},
                                     .q_noise = 5e-5,
                                     .dq_noise = 2e-3,
                                     .seed = day + 1,
                                     .bandwidth = 4.0};
    sources.emplace_back(testing::simulate_closed_form(robot, run), "day");
  }
  std::vector<LogSource*> logs;
  for (MemorySource& source : sources) logs.push_back(&source);
  const Robot robot = robot_from_toml("axes = \"RRP\"\n[known]\nl1 = 1.0\nl2 = 0.8\n", "robot");
  return fit_coarse_days(logs, robot, parameter_space(robot), TorqueTiming::held);
}

TEST(FitCoarseDays, FrictionThatDiffersByDayIsNotNoiseOfTheMeasurements) {
  const OneStepModel alike = fitted({1.0, 1.0, 1.0, 1.0}), differ = fitted({0.8, 1.2, 0.9, 1.1});
  for (int i = 0; i < 6; ++i)
    EXPECT_LT(std::sqrt(differ.reading_variance[i]), 2.0 * std::sqrt(alike.reading_variance[i])) << i;
  const testing::ClosedFormScara truth;
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(differ.theta[differ.layout().coulomb(j)] / truth.fc[j], 1.0, 0.1) << j;
    const int friction = differ.day_layout().friction(j);
    EXPECT_LT(std::sqrt(alike.day_variance[friction]), 0.05) << j;
    EXPECT_GT(std::sqrt(differ.day_variance[friction]), 0.1) << j;
    EXPECT_LT(std::sqrt(differ.day_variance[friction]), 0.4) << j;
  }
}

TEST(FitCoarseDays, MuchNoiseDoesNotHideTheIdentifiedRobot) {
  const testing::ClosedFormScara truth;
  std::vector<MemorySource> sources;
  for (std::uint64_t day = 1; day <= 3; ++day) {
    testing::ClosedFormRun run{.duration_s = 90.0,
                               .period_s = 0.06,
                               .reach = {1.0, 1.0, 0.1},
                               .q_noise = 0.25,
                               .dq_noise = 1.0,
                               .seed = day,
                               .bandwidth = 1.5};
    sources.emplace_back(testing::simulate_closed_form(truth, run), "day");
  }
  std::vector<LogSource*> logs;
  for (MemorySource& source : sources) logs.push_back(&source);
  Robot robot = robot_from_toml("axes = \"RRP\"\n[known]\nl1 = 1.0\nl2 = 0.8\n", "robot");
  robot = with_masses_and_lengths(robot, {1.1, 0.7, 0.55}, {1.0, 0.8, 0.0});  // as identified: some 10 % off
  const OneStepModel model = fit_coarse_days(logs, robot, parameter_space(robot), TorqueTiming::held);
  EXPECT_NEAR(model.theta[0] / truth.a(), 1.0, 0.03);
  EXPECT_NEAR(model.theta[1] / truth.b(), 1.0, 0.03);
  EXPECT_NEAR(model.theta[3] / truth.m3, 1.0, 0.01);
  EXPECT_NEAR(std::sqrt(model.reading_variance[0]), 0.25, 0.02);
  EXPECT_NEAR(std::sqrt(model.reading_variance[4]), 1.0, 0.08);
}

}  // namespace
}  // namespace faultline
