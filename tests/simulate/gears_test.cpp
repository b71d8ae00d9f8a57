// SPDX-License-Identifier: MIT
#include "lib/simulate/gears.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lib/core/error.hpp"
#include "lib/simulate/plant.hpp"
#include "tests/simulate/one_joint.hpp"
#include "tests/support/chain_mechanics.hpp"

/// Motions of motor and link whose closed form is known.
namespace faultline {
namespace {

constexpr double kMotor = 0.2;     // kg m^2
constexpr double kSpring = 800.0;  // N m/rad
constexpr double kTick_s = 0.001;
constexpr double kEver = std::numeric_limits<double>::infinity();

MachineSpec with_gears(double play = 0.0, double damping = 0.0) {
  MachineSpec machine;
  machine.gears = {.stiffness = {kSpring}, .damping = {damping}, .play = {play}, .motor_inertia = {kMotor}};
  return machine;
}

/// Ticks from `from` to `to` under a constant torque.
void run(Plant& plant, int from, int to, double tau) {
  for (int k = from; k < to; ++k) plant.advance(k * kTick_s, (k + 1) * kTick_s, one(tau));
}

double twist(const Plant& plant) { return plant.motor_q()[0] - plant.q[0]; }

TEST(Gears, TwoMassesSwingAtTheirNaturalFrequency) {
  Plant plant(one_joint(), {}, {}, kTick_s, with_gears());
  const double tau = 5.0, w = std::sqrt(kSpring * (1.0 / kMotor + 1.0 / kRodInertia));
  for (int k = 0; k < 2000; ++k) {  // some 20 swings
    run(plant, k, k + 1, tau);
    const double t = (k + 1) * kTick_s;
    ASSERT_NEAR(twist(plant), tau / kMotor / (w * w) * (1.0 - std::cos(w * t)), 3e-4 * tau / kSpring) << t;
    ASSERT_NEAR(kMotor * plant.motor_dq()[0] + kRodInertia * plant.dq[0], tau * t, 1e-9);
  }
}

TEST(Gears, StepsAreShortEnoughForTheSpringAlone) {
  constexpr double kLong_s = 0.05;  // most of a swing
  Plant plant(one_joint(), {}, {}, kLong_s, with_gears());
  const double tau = 5.0, w = std::sqrt(kSpring * (1.0 / kMotor + 1.0 / kRodInertia));
  for (int k = 0; k < 40; ++k) {
    plant.advance(k * kLong_s, (k + 1) * kLong_s, one(tau));
    ASSERT_NEAR(twist(plant), tau / kMotor / (w * w) * (1.0 - std::cos(w * (k + 1) * kLong_s)),
                0.02 * tau / kSpring);
  }
}

TEST(Gears, DampingReducesTheSwingAtItsRate) {
  const double damping = 0.4, sum = 1.0 / kMotor + 1.0 / kRodInertia;
  Plant plant(one_joint(), {}, {}, kTick_s, with_gears(0.0, damping));
  const double tau = 5.0, decay = 0.5 * damping * sum, w = std::sqrt(kSpring * sum - decay * decay);
  const double still = tau / kMotor / (kSpring * sum);
  for (int k = 0; k < 500; ++k) {
    run(plant, k, k + 1, tau);
    const double t = (k + 1) * kTick_s;
    const double swing = std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t));
    ASSERT_NEAR(twist(plant), still * (1.0 - swing), 3e-4 * still) << t;
  }
}

TEST(Gears, TheLinkStandsUntilTheMotorHasCrossedThePlay) {
  const double play = 0.004, tau = 2.0;
  const double crossed_s = std::sqrt(play * kMotor / tau);  // from the middle: half the play
  Plant plant(one_joint(), {}, {}, kTick_s, with_gears(play));
  const int last = static_cast<int>(crossed_s / kTick_s);
  run(plant, 0, last, tau);
  EXPECT_EQ(plant.dq[0], 0.0);
  EXPECT_NEAR(twist(plant), 0.5 * tau / kMotor * last * last * kTick_s * kTick_s, 1e-12);
  run(plant, last, last + 2, tau);
  EXPECT_GT(plant.dq[0], 0.0);
}

TEST(Gears, ASwingThroughThePlayLosesNoEnergy) {
  const double play = 0.01;
  Plant plant(one_joint(), {}, {}, kTick_s, with_gears(play));
  run(plant, 0, 100, 3.0);
  const auto energy = [&] {
    const double wound = std::max(std::abs(twist(plant)) - 0.5 * play, 0.0);
    return 0.5 * (kMotor * plant.motor_dq()[0] * plant.motor_dq()[0] +
                  kRodInertia * plant.dq[0] * plant.dq[0] + kSpring * wound * wound);
  };
  const double before = energy();
  int crossings = 0;
  double last = twist(plant);
  for (int k = 100; k < 3000; ++k) {
    run(plant, k, k + 1, 0.0);
    crossings += (twist(plant) > 0.0) != (last > 0.0);
    last = twist(plant);
    ASSERT_NEAR(energy(), before, 2e-3 * before) << k;
  }
  EXPECT_GT(crossings, 5);
}

TEST(Gears, AFlankNeverPulls) {
  const Gears gears(with_motors(one_joint(), with_gears(0.01, 50.0).gears).chain,
                    with_gears(0.01, 50.0).gears);
  EXPECT_EQ(gears.torque(0, 0.004, 3.0), 0.0) << "within the play";
  EXPECT_NEAR(gears.torque(0, 0.007, 0.0), kSpring * 0.002, 1e-12);
  EXPECT_NEAR(gears.torque(0, -0.007, 0.0), -kSpring * 0.002, 1e-12);
  EXPECT_EQ(gears.torque(0, 0.006, -1.0), 0.0) << "leaves faster than the spring follows";
}

/// Kinetic energy of motors, energy of links and springs of an arm with a rigid second joint.
double energy_of(const Robot& links, const Plant& plant, const GearSpec& gears) {
  double energy = kinetic_energy(links.chain, plant.q, plant.dq) + potential_energy(links.chain, plant.q);
  for (const int j : {0, 2}) {
    const double wound = plant.motor_q()[j] - plant.q[j];
    energy += 0.5 * (gears.motor_inertia[j] * plant.motor_dq()[j] * plant.motor_dq()[j] +
                     gears.stiffness[j] * wound * wound);
  }
  return energy;
}

TEST(Gears, AnArmWithSomeSpringsKeepsItsEnergy) {
  Robot robot = preset_robot("RRP");
  robot = with_masses_and_lengths(robot, {8.0, 5.0, 2.5}, {0.35, 0.3, 0.0});
  robot.chain.friction.assign(3, {});
  robot.chain.rotor_inertia = {0.0, 0.4, 0.0};
  MachineSpec machine;
  machine.gears = {.stiffness = {300.0, 0.0, 5e4}, .motor_inertia = {0.5, 0.4, 6.0}};
  Plant plant(robot, {}, {}, kTick_s, machine);
  JointVector q(3), dq(3), tau(3);
  q << 0.3, 0.9, -0.1;
  dq << 1.5, -2.0, 0.2;
  tau << 0.0, 0.0, 2.5 * 9.81;
  plant.start(q, dq);
  const double before = energy_of(robot, plant, machine.gears), hung = plant.motor_q()[2];
  double most_twist = 0.0;
  for (int k = 0; k < 2000; ++k) {
    plant.advance(k * kTick_s, (k + 1) * kTick_s, tau);
    most_twist = std::max(most_twist, std::abs(plant.motor_q()[0] - plant.q[0]));
    ASSERT_EQ(plant.motor_q()[1], plant.q[1]) << "a rigid gear";
    const double work = tau[2] * (plant.motor_q()[2] - hung);
    ASSERT_NEAR(energy_of(robot, plant, machine.gears) - work, before, 1e-4) << k;
  }
  EXPECT_GT(most_twist, 5e-4);
}

TEST(Gears, ALockStopsTheMotorAndTheLinkSwingsOn) {
  const double speed = 1.0, onset_s = 0.1005, w = std::sqrt(kSpring / kRodInertia);
  Plant plant(one_joint(), {}, {{FaultKind::locked, 1_joint, onset_s, kEver}}, kTick_s, with_gears());
  plant.start(one(0.0), one(speed));
  run(plant, 0, 100, 0.0);
  EXPECT_NEAR(twist(plant), 0.0, 1e-12);
  run(plant, 100, 101, 0.0);
  for (int k = 101; k < 400; ++k) {
    run(plant, k, k + 1, 7.0);
    ASSERT_EQ(plant.motor_dq()[0], 0.0);
    ASSERT_NEAR(plant.motor_q()[0], speed * onset_s, 1e-12);
    const double since = (k + 1) * kTick_s - onset_s;
    ASSERT_NEAR(-twist(plant), speed / w * std::sin(w * since), 1e-4 * speed / w);
  }
}

TEST(Gears, APushActsOnTheLinkAndALostTorqueOnTheMotor) {
  const double play = 0.01;
  const SimulatedFault push{FaultKind::collision, 1_joint, 0.0, 1.0, 3.0};
  Plant pushed(one_joint(), {}, {push}, kTick_s, with_gears(play));
  run(pushed, 0, 10, 0.0);
  EXPECT_NEAR(pushed.dq[0], 3.0 / kRodInertia * 0.01, 1e-9);
  EXPECT_EQ(pushed.motor_dq()[0], 0.0);
  const SimulatedFault misread{FaultKind::torque_sensor_error, 1_joint, 0.0, kEver, 3.0};
  Plant weak(one_joint(), {}, {misread}, kTick_s, with_gears(play));
  run(weak, 0, 10, 0.0);
  EXPECT_NEAR(weak.motor_dq()[0], -3.0 / kMotor * 0.01, 1e-9);
  EXPECT_EQ(weak.dq[0], 0.0);
}

TEST(Gears, FrictionBrakesTheMotor) {
  Robot robot = one_joint();
  robot.chain.friction[0].viscous = 2.0;
  Plant plant(robot, {}, {}, kTick_s, with_gears(0.1));
  plant.start(one(0.0), one(0.5));
  run(plant, 0, 50, 0.0);
  EXPECT_NEAR(plant.motor_dq()[0], 0.5 * std::exp(-2.0 / kMotor * 0.05), 1e-6);
  EXPECT_EQ(plant.dq[0], 0.5) << "nothing brakes the link within the play";
}

TEST(Gears, AStopHoldsTheLinkWhileTheMotorWindsTheSpring) {
  const JointStops stops{.low = {-1.0}, .high = {0.2}};
  Robot robot = one_joint();
  robot.chain.friction[0].viscous = 5.0;
  Plant plant(robot, stops, {}, kTick_s, with_gears(0.0, 5.0));
  run(plant, 0, 5000, 4.0);
  EXPECT_NEAR(plant.q[0], 0.2 + 4.0 / (200.0 * 200.0 * (kRodInertia + kMotor)), 1e-6);
  EXPECT_NEAR(twist(plant), 4.0 / kSpring, 1e-6);
}

TEST(Gears, AWeightHangsAtRestFromTheStart) {
  Robot robot = preset_robot("P");
  robot = with_masses_and_lengths(robot, {3.0}, {0.0});
  robot.chain.friction = {{}};
  MachineSpec machine;
  machine.gears = {.stiffness = {2e4}, .play = {1e-3}, .motor_inertia = {5.0}};
  Plant plant(robot, {}, {}, kTick_s, machine);
  plant.start(one(-0.1), one(0.0));
  EXPECT_NEAR(plant.q[0], -0.1 - 3.0 * 9.81 / 2e4 - 0.5e-3, 1e-12);
  EXPECT_EQ(plant.motor_q()[0], -0.1);
  run(plant, 0, 1000, 3.0 * 9.81);
  EXPECT_NEAR(plant.dq[0], 0.0, 1e-10);
  EXPECT_NEAR(plant.motor_q()[0], -0.1, 1e-10);
}

void expect_refused(const Robot& robot, const GearSpec& spec, const char* key) {
  try {
    check_gears(robot, spec);
    FAIL() << key;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_EQ(error.where(), std::string("gears.") + key);
  }
}

TEST(Gears, ImpossibleValuesAreRefused) {
  const Robot robot = one_joint();
  expect_refused(robot, {.stiffness = {-1.0}}, "stiffness");
  expect_refused(robot, {.stiffness = {1.0, 1.0}}, "stiffness");
  expect_refused(robot, {.stiffness = {1.0}, .damping = {-1.0}, .motor_inertia = {1.0}}, "damping");
  expect_refused(robot, {.stiffness = {1.0}, .play = {-1.0}, .motor_inertia = {1.0}}, "play");
  expect_refused(robot, {.stiffness = {1.0}, .motor_inertia = {-1.0}}, "motor_inertia");
  expect_refused(robot, {.stiffness = {1.0}}, "motor_inertia");
  expect_refused(robot, {.play = {0.01}}, "play");
  expect_refused(robot, {.damping = {1.0}}, "damping");
  Robot shared = robot;
  shared.chain.shared_drives = {{.along = Eigen::VectorXd::Ones(1)}};
  expect_refused(shared, {.stiffness = {1.0}, .motor_inertia = {1.0}}, "stiffness");
  Robot without_mass = robot;
  without_mass.chain.links[0] = {};
  expect_refused(without_mass, {.stiffness = {1.0}, .motor_inertia = {1.0}}, "stiffness");
  Robot with_rotor = robot;
  with_rotor.chain.rotor_inertia = {0.1};
  EXPECT_NO_THROW(check_gears(with_rotor, {.stiffness = {1.0}}));
}

}  // namespace
}  // namespace faultline
