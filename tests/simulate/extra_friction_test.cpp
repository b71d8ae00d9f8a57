// SPDX-License-Identifier: MIT
#include "lib/simulate/extra_friction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/simulate/simulate.hpp"
#include "tests/simulate/one_joint.hpp"
#include "tests/simulate/short_runs.hpp"

namespace faultline {
namespace {

constexpr double kCoulomb = 2.0, kViscous = 0.8, kWidth = 0.002;
constexpr double kTick_s = 0.001;

Robot dry_joint(double viscous = 0.0) {
  Robot robot = one_joint();
  robot.chain.friction = {{viscous, kCoulomb, 0.0, kWidth}};
  return robot;
}

/// The speed of a joint that begins at `speed`, after so long under a constant torque.
double speed_after(double seconds, const Robot& robot, const MachineSpec& machine, double speed, double tau) {
  Plant plant(robot, {}, {}, kTick_s, machine);
  plant.start(one(0.0), one(speed));
  const int ticks = static_cast<int>(std::lround(seconds / kTick_s));
  for (int k = 0; k < ticks; ++k) plant.advance(k * kTick_s, (k + 1) * kTick_s, one(tau));
  return plant.dq[0];
}

MachineSpec sticking() {
  MachineSpec machine;
  machine.stick_slip = {.share = {0.5}, .speed = {0.1}};
  return machine;
}

TEST(StickSlip, AJointNeedsMoreTorqueToBreakAwayThanToSlide) {
  EXPECT_LT(std::abs(speed_after(1.0, dry_joint(), sticking(), 0.0, 2.8)), 5.0 * kWidth) << "sticks";
  EXPECT_GT(speed_after(1.0, dry_joint(), sticking(), 0.0, 3.1), 1.0) << "beyond 1.5 times Coulomb";
  EXPECT_GT(speed_after(1.0, dry_joint(), {}, 0.0, 2.8), 1.0) << "without it, beyond Coulomb";
  EXPECT_NEAR(speed_after(1.0, dry_joint(), sticking(), 1.0, 2.8), 1.0 + 0.8 / kRodInertia, 1e-3) << "slides";
}

TEST(StickSlip, FollowsTheCurveOfTheSpec) {
  const Robot robot = dry_joint();
  const ExtraFriction extra(robot.chain, {.share = {0.5}, .speed = {0.1}}, {});
  ASSERT_TRUE(extra.any());
  for (const double v : {-0.3, -0.05, 0.0, 0.001, 0.1, 0.2})
    EXPECT_NEAR(extra.torque(0, v, robot.chain.friction[0]),
                0.5 * kCoulomb * std::exp(-v * v / 0.01) * std::tanh(v / kWidth), 1e-12);
}

TEST(StickSlip, TheStepIsShortEnoughForStickSlip) {
  SimulationSpec spec = short_run(2.0);
  spec.machine.stick_slip = {.share = {0.6, 0.6, 0.6}, .speed = {0.05, 0.05, 0.02}};
  const Log usual = simulate(industrial(), spec).log;
  spec.max_step_s = 2e-5;
  const Log exact = simulate(industrial(), spec).log;
  for (int k = 0; k < usual.rows(); k += 50)
    EXPECT_LT((row_of(usual.q, k) - row_of(exact.q, k)).cwiseAbs().maxCoeff(), 1e-5);
}

MachineSpec cold() {
  MachineSpec machine;
  machine.warm_up = {.share = {0.6}, .time_s = {4.0}};
  return machine;
}

TEST(WarmUp, FrictionFallsFromItsStartToThatOfTheModel) {
  const Robot robot = dry_joint(kViscous);
  ExtraFriction extra(robot.chain, {}, {.share = {0.6}, .time_s = {4.0}});
  const double sliding = kViscous * 1.5 + kCoulomb;
  for (const double t : {0.0, 4.0, 8.0}) {
    extra.set_time(t);
    EXPECT_NEAR(extra.torque(0, 1.5, robot.chain.friction[0]), 0.6 * std::exp(-t / 4.0) * sliding, 1e-12);
  }
  extra.set_time(1000.0);
  EXPECT_NEAR(extra.torque(0, 1.5, robot.chain.friction[0]), 0.0, 1e-12);
}

TEST(WarmUp, AColdJointSlowsDownFaster) {
  const double lost = 30.0 - speed_after(1.0, dry_joint(), cold(), 30.0, 0.0);
  const double warmth = 4.0 * (1.0 - std::exp(-0.25));  // integral of exp(-t / 4 s) over the second
  EXPECT_NEAR(lost, kCoulomb * (1.0 + 0.6 * warmth) / kRodInertia, 1e-6);
}

TEST(WarmUp, FrictionThatAFaultAddsDoesNotWarmUp) {
  const Robot robot = dry_joint();
  const ExtraFriction extra(robot.chain, {}, {.share = {0.6}, .time_s = {4.0}});
  Friction now = robot.chain.friction[0];
  now.coulomb += 5.0;
  EXPECT_NEAR(extra.torque(0, 1.0, now), 0.6 * kCoulomb, 1e-12);
}

TEST(ExtraFriction, AColdOrFaultyJointNeedsMoreTorqueToBreakAway) {
  const Robot robot = dry_joint();
  ExtraFriction extra(robot.chain, {.share = {0.5}, .speed = {0.1}}, {.share = {0.6}, .time_s = {4.0}});
  extra.set_time(4.0);
  Friction now = robot.chain.friction[0];
  now.coulomb += 5.0;
  const double v = 0.05, cold = 0.6 * std::exp(-1.0) * kCoulomb;
  const double expected = cold + 0.5 * std::exp(-0.25) * (kCoulomb + 5.0 + cold);
  EXPECT_NEAR(extra.torque(0, v, now), expected * std::tanh(v / kWidth), 1e-12);
}

TEST(ExtraFriction, IsNeverSteeperThanItsStatedBound) {
  const Robot robot = dry_joint(kViscous);
  const ExtraFriction extra(robot.chain, {.share = {0.5}, .speed = {0.02}},
                            {.share = {0.6}, .time_s = {4.0}});
  const Friction now = robot.chain.friction[0], worst = extra.worst(0, now);
  const auto total = [&](double v) {
    return now.viscous * v + now.coulomb * std::tanh(v / now.width) + extra.torque(0, v, now);
  };
  for (double v = -0.1; v < 0.1; v += 1e-4) {
    const double slope = (total(v + 1e-7) - total(v - 1e-7)) / 2e-7;
    ASSERT_LE(slope, steepest(worst)) << v;
    if (std::abs(v) > 8.0 * kWidth) {
      ASSERT_LE(std::abs(slope), worst.viscous) << v;
    }
  }
}

TEST(ExtraFriction, BrakesTheMotorIfTheGearHasASpring) {
  MachineSpec machine = cold();
  machine.gears = {.stiffness = {1000.0}, .play = {0.5}, .motor_inertia = {0.2}};
  Plant plant(dry_joint(), {}, {}, kTick_s, machine);
  plant.start(one(0.0), one(2.0));
  for (int k = 0; k < 50; ++k) plant.advance(k * kTick_s, (k + 1) * kTick_s, one(0.0));
  EXPECT_EQ(plant.dq[0], 2.0);
  EXPECT_NEAR(plant.motor_dq()[0], 2.0 - kCoulomb * (1.0 + 0.6 * std::exp(-0.025 / 4.0)) / 0.2 * 0.05, 1e-4);
}

template <typename Check>
void expect_refused(const Check& check, const char* key) {
  try {
    check();
    FAIL() << key;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_EQ(error.where(), key);
  }
}

TEST(ExtraFriction, ImpossibleValuesAreRefused) {
  const auto stick = [](StickSlipSpec spec) { return [spec] { check_stick_slip(1, spec); }; };
  const auto warm = [](WarmUpSpec spec) { return [spec] { check_warm_up(1, spec); }; };
  expect_refused(stick({.share = {-0.1}, .speed = {1.0}}), "stick_slip.share");
  expect_refused(stick({.share = {0.1, 0.1}, .speed = {1.0}}), "stick_slip.share");
  expect_refused(stick({.share = {0.1}}), "stick_slip.speed");
  expect_refused(stick({.share = {0.1}, .speed = {0.0}}), "stick_slip.speed");
  expect_refused(warm({.share = {-0.1}, .time_s = {1.0}}), "warm_up.share");
  expect_refused(warm({.share = {0.1}}), "warm_up.time_s");
  expect_refused(warm({.share = {0.1}, .time_s = {-1.0}}), "warm_up.time_s");
  EXPECT_NO_THROW(check_stick_slip(1, {.share = {0.0}}));
}

}  // namespace
}  // namespace faultline
