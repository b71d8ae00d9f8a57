// SPDX-License-Identifier: MIT
#include "lib/learn/day_differences.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/identify/days/fit_coarse_days.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/explain/explained_scara.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

/// An identification whose values and doubts are all those of no robot.
Identification identification_of(const Robot& robot) {
  Identification out;
  out.space = parameter_space(robot);
  out.robot = robot;
  out.estimate = Eigen::VectorXd::Constant(out.space.count(), 7.0);
  out.covariance = Eigen::MatrixXd::Identity(out.space.count(), out.space.count());
  out.q_noise = out.dq_noise = {1.0, 1.0, 1.0};
  return out;
}

TEST(ExplainedRobot, TheTwinHasTheNoiseAndTheVariancesOfTheModel) {
  std::vector<MemorySource> days;
  for (std::uint64_t day = 1; day <= 3; ++day)
    days.emplace_back(testing::simulate_closed_form({}, {.duration_s = 10.0,
                                                         .period_s = 0.025,
                                                         .reach = {0.8, 0.9, 0.1},
                                                         .q_noise = 5e-5,
                                                         .dq_noise = 2e-3,
                                                         .seed = day,
                                                         .bandwidth = 4.0}),
                      "day");
  std::vector<LogSource*> logs;
  for (MemorySource& day : days) logs.push_back(&day);
  const Robot robot = robot_from_toml("axes = \"RRP\"\n[known]\nl1 = 1.0\nl2 = 0.8\n", "robot");
  const Identification identified = identification_of(robot);
  const OneStepModel model = fit_coarse_days(logs, robot, identified.space, TorqueTiming::held);
  const Identification twin = with_explained_robot(identified, model);
  const ParameterSpace& space = twin.space;
  int at = 0;
  for (int p = 0; p < space.rigid(); ++p)
    EXPECT_EQ(twin.estimate[p], space.base[p].is_rotor ? 0.0 : model.theta[at++]) << space.name(p);
  for (int j = 0; j < 3; ++j) {
    EXPECT_EQ(twin.estimate[space.coulomb(j)], model.theta[model.layout().coulomb(j)]) << j;
    EXPECT_EQ(twin.q_noise[j], std::sqrt(model.reading_variance[j])) << j;
    EXPECT_EQ(twin.dq_noise[j], std::sqrt(model.reading_variance[3 + j])) << j;
  }
  EXPECT_NEAR(std::sqrt(twin.covariance(0, 0)),
              model.theta[0] * std::sqrt(model.day_variance[model.day_layout().inertia(0)]), 1e-12);
  EXPECT_EQ(twin.covariance(space.viscous(0), space.viscous(0)), 0.0);
}

TEST(ExplainedRobot, TheTwinHasInertiaAndFrictionOfTheModel) {
  const BalanceModel& model = testing::scara_model();
  const Identification twin = with_explained_robot(identification_of(testing::scara_robot()), model);
  const ParameterSpace& space = twin.space;
  for (int p = 0; p < space.rigid(); ++p) {
    EXPECT_NEAR(twin.estimate[p], std::max(model.theta[p], 0.0), 1e-12) << space.name(p);
    EXPECT_NEAR(twin.covariance(p, p), model.day_variance[p] * std::pow(model.theta[p], 2), 1e-12) << p;
  }
  EXPECT_EQ(twin.covariance(space.viscous(0), space.viscous(0)), 0.0);
}

TEST(ExplainedRobot, FrictionThatFallsWithSpeedBecomesThatOfHalfTheTopSpeed) {
  BalanceModel model = testing::scara_model();
  double& viscous = model.theta[model.layout().viscous(1)];
  const double coulomb = model.theta[model.layout().coulomb(1)];
  viscous = -0.5 * coulomb / model.top_speed[1];
  const Identification twin = with_explained_robot(identification_of(testing::scara_robot()), model);
  EXPECT_EQ(twin.estimate[twin.space.viscous(1)], 0.0);
  EXPECT_NEAR(twin.estimate[twin.space.coulomb(1)], 0.75 * coulomb, 1e-9);
}

TEST(StatedRanges, ApplyToAllFrictionEffectsOfTheDay) {
  const BalanceModel& learned = testing::scara_model();
  NormalRange stated;
  stated.friction = 0.6;
  const auto wide = std::get<BalanceModel>(with_stated_ranges(learned, stated, {1.0, 1.0, 1.0}));
  const DayLayout day = day_layout(learned);
  for (int j = 0; j < 3; ++j)
    for (const int effect : {day.friction(j), day.friction_slope(j), day.viscous_excess(j)})
      EXPECT_NEAR(std::sqrt(wide.day_variance[effect]), 0.3, 1e-12) << effect;
  EXPECT_EQ(wide.day_variance[day.gain(0)], learned.day_variance[day.gain(0)]);
}

}  // namespace
}  // namespace faultline
