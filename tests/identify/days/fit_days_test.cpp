// SPDX-License-Identifier: MIT
// One joint in closed form: rigid and light, or with a gear that gives way.
#include "lib/identify/days/fit_days.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/core/random.hpp"
#include "lib/identify/days/draft_rows.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

constexpr double kStiffness = 3000.0;  // N m/rad

/// A drive and a link, with a spring between them; the encoder sits on the drive, friction acts on the link.
struct OneJoint {
  double drive_inertia = 0.0, link_inertia = 1.2;  ///< kg m^2; without a drive's, the gear is rigid
  double coulomb = 3.0;                            ///< N m; viscous friction: a third of it a rad/s
  double encoder_step = 0.0;  ///< rad; above 0, the velocity is the difference of its positions
  double limit = 1e9;         ///< N m: more torque does not arrive
};

double rounded(double q, double step) { return step > 0.0 ? step * std::round(q / step) : q; }

constexpr double kWidth = 0.01;  // rad/s
constexpr double kBandwidth = 12.0;

double friction(double coulomb, double speed) { return coulomb * (std::tanh(speed / kWidth) + speed / 3.0); }

/// A sum of sines followed by a controller on the drive, torque held over a row; white noise.
Log day(const OneJoint& joint, double period_s, std::uint64_t seed) {
  constexpr double kStep_s = 2e-5, kRate[] = {2.1, 4.7, 9.3}, kReach[] = {0.5, 0.2, 0.05};
  Random random(seed);
  double phase[3];
  for (double& p : phase) p = random.uniform(0.0, 2.0 * std::numbers::pi);
  const bool is_rigid = joint.drive_inertia == 0.0;
  const double inertia = joint.drive_inertia + joint.link_inertia;
  double q[2] = {}, dq[2] = {};  // drive, link
  Log log;
  log.q.resize(1);
  log.dq.resize(1);
  log.tau.resize(1);
  for (int row = 0; row * period_s < 20.0; ++row) {
    const double t = row * period_s;
    double r = 0.0, dr = 0.0, ddr = 0.0;
    for (int i = 0; i < 3; ++i) {
      r += kReach[i] * std::sin(kRate[i] * t + phase[i]);
      dr += kReach[i] * kRate[i] * std::cos(kRate[i] * t + phase[i]);
      ddr -= kReach[i] * kRate[i] * kRate[i] * std::sin(kRate[i] * t + phase[i]);
    }
    const double tau =
        inertia * (ddr + kBandwidth * kBandwidth * (r - q[0]) + 2.0 * kBandwidth * (dr - dq[0])) +
        friction(joint.coulomb, dr);
    log.time.push_back(t);
    log.q[0].push_back(rounded(q[0] + 2e-5 * random.normal(), joint.encoder_step));
    const double before = log.q[0].size() > 1 ? log.q[0].end()[-2] : log.q[0].back();
    const double measured = dq[0] + 2e-3 * random.normal();
    log.dq[0].push_back(joint.encoder_step > 0.0 ? (log.q[0].back() - before) / period_s : measured);
    log.tau[0].push_back(tau);
    const double given = std::clamp(tau, -joint.limit, joint.limit);
    for (int i = 0; i < std::lround(period_s / kStep_s); ++i) {
      if (is_rigid) {
        dq[0] += kStep_s * (given - friction(joint.coulomb, dq[0])) / inertia;
      } else {
        const double spring = kStiffness * (q[0] - q[1]) + 2.0 * (dq[0] - dq[1]);
        dq[0] += kStep_s * (given - spring) / joint.drive_inertia;
        dq[1] += kStep_s * (spring - friction(joint.coulomb, dq[1])) / joint.link_inertia;
      }
      for (int k = 0; k < 2; ++k) q[k] += kStep_s * dq[k];
    }
  }
  return log;
}

BalanceModel fitted(const OneJoint& joint, double period_s) {
  std::vector<MemorySource> sources;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) sources.emplace_back(day(joint, period_s, seed), "day");
  std::vector<LogSource*> logs;
  for (MemorySource& source : sources) logs.push_back(&source);
  const Robot robot = robot_from_toml("axes = \"R\"\ngravity = [0, 0, -9.81]\n", "robot");
  return fit_days(logs, parameter_space(robot), TorqueTiming::held).model;
}

TEST(FitDays, ALightRigidJointThatReversesHasNoCompliance) {
  const BalanceModel model = fitted({.link_inertia = 0.004, .coulomb = 0.6}, 0.01);
  EXPECT_EQ(model.compliance(0), 0.0);
  EXPECT_EQ(model.setting.compliance[0], 0.0);
  EXPECT_NEAR(model.theta[model.layout().coulomb(0)], 0.6, 0.01);
  EXPECT_NEAR(model.theta[model.layout().delay(0)], 0.0, 0.1);
}

TEST(FitDays, AnElasticGearHasItsCompliance) {
  const OneJoint joint{.drive_inertia = 0.05};
  const BalanceModel model = fitted(joint, 0.002);
  EXPECT_NEAR(model.compliance(0) * kStiffness, 1.0, 0.2);
  EXPECT_NEAR(model.setting.compliance[0] / model.compliance(0), 1.0, 0.01);
}

TEST(FitDays, ACoarseEncoderDoesNotMakeTheInertiaSmaller) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const BalanceModel model = fitted({.encoder_step = kTurn / 2000.0}, 0.002);
  EXPECT_GT(model.setting.kernel_s, 0.02);
  EXPECT_NEAR(model.theta[0], 1.2, 0.02);
  EXPECT_NEAR(model.theta[model.layout().coulomb(0)], 3.0, 0.1);
}

TEST(FitDays, ADriveThatGivesNoMoreTorqueHasItsLimit) {
  const BalanceModel model = fitted({.limit = 14.0}, 0.002);
  EXPECT_NEAR(model.drive_limit[0], 14.0, 0.3);
  EXPECT_NEAR(model.theta[0], 1.2, 0.02);
  EXPECT_NEAR(model.theta[model.layout().coulomb(0)], 3.0, 0.1);
}

TEST(FitDays, DrivesThatGiveAllTorqueHaveNoLimit) {
  EXPECT_EQ(fitted({}, 0.002).drive_limit[0], 0.0);
  EXPECT_EQ(fitted({.drive_inertia = 0.05}, 0.002).drive_limit[0], 0.0) << "a gear that gives way";
  for (int j = 0; j < 3; ++j) EXPECT_EQ(testing::scara_model().drive_limit[j], 0.0);
}

TEST(FitDays, LoadFrictionIsEstimatedIfTheIdentificationHasIt) {
  std::vector<Log> days;
  for (int day = 0; day < 3; ++day) {
    testing::ClosedFormScara scara = testing::of_day(day);
    scara.load = {0.06, 0.0, 0.04};
    days.push_back(simulate_closed_form(scara, testing::run_of(day + 1)));
  }
  Robot robot = testing::scara_robot();
  robot.chain.friction[0].load = robot.chain.friction[2].load = 0.1;
  const BalanceModel model = testing::learned_from(days, robot).model;
  EXPECT_NEAR(model.theta[model.layout().load(0)], 0.06, 0.005);
  EXPECT_EQ(model.theta[model.layout().load(1)], 0.0);
  EXPECT_NEAR(model.theta[model.layout().load(2)], 0.04, 0.005);
}

TEST(FitDays, NegativeLoadFrictionIsLeftOut) {
  std::vector<Log> days;
  for (int day = 0; day < 3; ++day) {
    testing::ClosedFormScara scara = testing::of_day(day);
    scara.load = {-0.05, 0.0, 0.04};
    days.push_back(simulate_closed_form(scara, testing::run_of(day + 1)));
  }
  Robot robot = testing::scara_robot();
  robot.chain.friction[0].load = robot.chain.friction[2].load = 0.1;
  const BalanceModel model = testing::learned_from(days, robot).model;
  EXPECT_EQ(model.theta[model.layout().load(0)], 0.0);
  EXPECT_NEAR(model.theta[model.layout().load(2)], 0.04, 0.005);
}

TEST(FitDays, ACoupledDriveHasItsFriction) {
  std::vector<Log> days;
  for (int day = 0; day < 3; ++day) {
    testing::ClosedFormScara scara = testing::of_day(day);
    scara.shared_fv = 0.4, scara.shared_fc = 0.8;
    days.push_back(simulate_closed_form(scara, testing::run_of(day + 1)));
  }
  Robot robot = testing::scara_robot();
  robot.chain.shared_drives = {
      {.along = Eigen::Vector3d(1.0, 1.0, 0.0), .viscous = 0.1, .coulomb = 0.1, .width = 0.02}};
  const BalanceModel model = testing::learned_from(days, robot).model;
  const int drive = model.layout().drive(0);
  EXPECT_NEAR(model.theta[drive + 1], 0.4, 0.05);
  EXPECT_NEAR(model.theta[drive + 2], 0.8, 0.05);
  EXPECT_NEAR(model.theta[model.layout().coulomb(1)], 0.4, 0.05);
}

TEST(DraftSetting, AVelocityWithoutNoiseGivesAFiniteVelocity) {
  UniformLog log = testing::on_grid(testing::simulate_closed_form(testing::of_day(0), testing::run_of(1)));
  log.dq_noise.setZero();
  EXPECT_TRUE(fused_velocity(log, draft_setting({log}, 0.016, 0.032)).allFinite());
}

}  // namespace
}  // namespace faultline
