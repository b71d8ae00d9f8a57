// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/fault_dynamics.hpp"

#include <gtest/gtest.h>

#include "tests/reproduce/filter/mechanical_faults.hpp"

namespace faultline {
namespace {

using mechanical::draw_state;
using mechanical::draw_torque;
using mechanical::every_fault;
using mechanical::Fault;
using mechanical::fault_of;
using mechanical::joint_array;
using mechanical::motion_of;
using mechanical::name_of;
using mechanical::sized;
using mechanical::Twin;
using State = FaultyScara::State;
using Triple = FaultyScara::Triple;

Acceleration evaluated(const FaultDynamics& dynamics, const State& x, const Triple& torque,
                       const Fault& fault) {
  return dynamics.evaluate(motion_of(x), joint_array(torque), sized(fault));
}

/// Largest difference of q and dq between integrate() over `dt` and the closed form, over some states.
double largest_error(const Twin& twin, Fault fault, double dt, double fine_step_s = 1e-4) {
  fault.truth.width = twin.truth.width;
  const int steps = static_cast<int>(std::ceil(dt / fine_step_s));
  Random random(3);
  double largest = 0.0;
  for (int draw = 0; draw < 5; ++draw) {
    const State start = draw_state(random, fault);
    const Triple torque = draw_torque(random);
    const State expected = fault.truth.after(start, torque, dt, steps);
    MotionState x = motion_of(start);
    twin.dynamics.integrate(x, joint_array(torque), dt, sized(fault));
    for (int j = 0; j < 3; ++j)
      largest = std::max({largest, std::abs(x.q[j] - expected.q[j]), std::abs(x.dq[j] - expected.dq[j])});
  }
  return largest;
}

TEST(FaultDynamics, AccelerationsAreThoseOfTheClosedForm) {
  const Twin twin;
  Random random(1);
  for (const Fault& fault : every_fault()) {
    for (int draw = 0; draw < 20; ++draw) {
      const State x = draw_state(random, fault);
      const Triple torque = draw_torque(random), expected = fault.truth.acceleration(x, torque);
      const Acceleration at = evaluated(twin.dynamics, x, torque, fault);
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(at.value[j], expected[j], 1e-9 * (1.0 + std::abs(expected[j])))
            << name_of(fault) << ", joint " << j + 1;
    }
  }
}

TEST(FaultDynamics, WithoutAHypothesisTheRobotIsHealthy) {
  const Twin twin;
  Random random(2);
  const State x = draw_state(random, fault_of(FaultKind::sensor_bias, 1));
  const Triple torque = draw_torque(random), expected = twin.truth.acceleration(x, torque);
  const Acceleration at = twin.dynamics.evaluate(motion_of(x), joint_array(torque));
  for (int j = 0; j < 3; ++j) EXPECT_NEAR(at.value[j], expected[j], 1e-9 * (1.0 + std::abs(expected[j])));
}

TEST(FaultDynamics, ALockedJointBearsNoInertia) {
  const Twin twin;
  const Fault fault = fault_of(FaultKind::locked, 2);
  const Acceleration at =
      evaluated(twin.dynamics, State{{0.3, 0.8, -0.1}, {1.0, 0.0, 0.2}}, {5, 3, 20}, fault);
  EXPECT_EQ(at.value[1], 0.0);
  for (int j = 0; j < 3; ++j) EXPECT_EQ(at.inverse_inertia[3 + j] + at.inverse_inertia[3 * j + 1], 0.0);
}

/// Central difference of the accelerations in one number.
template <typename Change>
Triple slope(const Twin& twin, const Fault& fault, const State& x, const Triple& torque, Change change) {
  constexpr double kStep = 1e-5;
  Triple out;
  Fault f = fault;
  State s = x;
  change(f, s, kStep);
  const Acceleration more = evaluated(twin.dynamics, s, torque, f);
  change(f, s, -2.0 * kStep);
  const Acceleration less = evaluated(twin.dynamics, s, torque, f);
  for (int j = 0; j < 3; ++j) out[j] = (more.value[j] - less.value[j]) / (2.0 * kStep);
  return out;
}

TEST(FaultDynamics, SizeTorquesAreTheDerivativesByTheSize) {
  const Twin twin;
  Random random(4);
  for (const Fault& fault : every_fault()) {
    if (is_everywhere(fault.hypothesis)) continue;  // one size a joint: the inverse inertia itself
    const State x = draw_state(random, fault);
    const Triple torque = draw_torque(random);
    const Acceleration at = evaluated(twin.dynamics, x, torque, fault);
    for (int s = 0; s < 2; ++s) {
      const Triple expected =
          slope(twin, fault, x, torque, [s](Fault& f, State&, double by) { f.size[s] += by; });
      for (int i = 0; i < 3; ++i) {
        double sum = 0.0;
        for (int j = 0; j < 3; ++j) sum += at.inverse_inertia[3 * i + j] * at.size_torque[s][j];
        EXPECT_NEAR(sum, expected[i], 1e-5 * (1.0 + std::abs(expected[i]))) << name_of(fault) << ", " << s;
      }
    }
  }
}

TEST(FaultDynamics, TheFrictionSlopeIsThatOfFrictionAtTheJoint) {
  const Twin twin;
  const Fault fault = fault_of(FaultKind::friction_increase, 3, {4.0, 5.0});
  const State x{{0.3, 0.8, -0.1}, {1.0, 0.3, 0.006}};
  const Acceleration at = evaluated(twin.dynamics, x, {5, 3, 20}, fault);
  const Triple by_speed =
      slope(twin, fault, x, {5, 3, 20}, [](Fault&, State& s, double by) { s.dq[2] += by; });
  EXPECT_NEAR(-at.friction_slope[2] / twin.truth.m3, by_speed[2], 1e-4 * std::abs(by_speed[2]));
  EXPECT_NEAR(at.friction_slope[0], twin.truth.fv[0], 1e-6) << "sliding: nothing but viscous";
  EXPECT_GE(at.stiffness, at.friction_slope[2] / twin.truth.m3 * (1.0 - 1e-9));
}

TEST(Integrate, ShortStepsFollowTheClosedForm) {
  const Twin twin;
  for (const Fault& fault : every_fault())
    EXPECT_LT(largest_error(twin, fault, 0.002), 5e-3) << name_of(fault);
}

TEST(Integrate, LongStepsFollowTheClosedForm) {
  const Twin twin;
  for (const double dt : {0.01, 0.02, 0.073})
    for (const Fault& fault : every_fault())
      EXPECT_LT(largest_error(twin, fault, dt), dt < 0.05 ? 0.02 : 0.1) << name_of(fault) << " over " << dt;
}

TEST(Integrate, WithoutDryFrictionItIsOfItsRulesOrder) {
  FaultyScara robot;
  robot.fc = {0.0, 0.0, 0.0};
  const Twin smooth(robot);
  for (Fault fault : every_fault()) {
    if (fault.hypothesis.label.kind == FaultKind::friction_increase) continue;
    fault.truth.fc = {0.0, 0.0, 0.0};
    EXPECT_LT(largest_error(smooth, fault, 0.002), 4e-4) << name_of(fault);
    EXPECT_LT(largest_error(smooth, fault, 0.02), 1e-4) << name_of(fault);
  }
}

TEST(Integrate, StiffFrictionStaysStableAndNearTheClosedForm) {
  FaultyScara stiff;
  stiff.width = {0.001, 0.001, 0.001};
  const Twin twin(stiff);
  for (const double dt : {0.004, 0.02, 0.073})
    for (const Fault& fault : every_fault())
      EXPECT_LT(largest_error(twin, fault, dt, 1e-5), dt < 0.01 ? 0.02 : 0.1)
          << name_of(fault) << " over " << dt;
}

TEST(Integrate, ASlideThroughSharpFrictionIsExact) {
  FaultyScara robot;
  robot.fv = robot.fo = {0.0, 0.0, 0.0};
  robot.width = {1e-4, 1e-4, 1e-4};
  const Twin twin(robot);
  MotionState x = motion_of(State{{0.0, 0.5, 0.0}, {0.0, 0.0, 1.0}});
  const Triple hold = {0.0, 0.0, robot.m3 * 9.81};
  constexpr double kStep_s = 0.073;
  twin.dynamics.integrate(x, joint_array(hold), kStep_s);
  const double braking = 8.0 / robot.m3;
  EXPECT_NEAR(x.dq[2], 1.0 - braking * kStep_s, 1e-9);
  EXPECT_NEAR(x.q[2], kStep_s - 0.5 * braking * kStep_s * kStep_s, 1e-9);
}

/// The largest speed that is left of a slow motion which friction of that width stops for 20 steps.
double speed_left(double width, double dt) {
  FaultyScara robot;
  robot.width = {width, width, width};
  robot.fo = {0.0, 0.0, 0.0};
  const Twin twin(robot);
  MotionState x = motion_of(State{{0.0, 0.5, -0.1}, {0.01, -0.01, 0.005}});
  const Triple hold = {0.0, 0.0, robot.m3 * 9.81};
  for (int k = 0; k < 20; ++k) twin.dynamics.integrate(x, joint_array(hold), dt);
  return std::max({std::abs(x.dq[0]), std::abs(x.dq[1]), std::abs(x.dq[2])});
}

TEST(Integrate, AJointThatFrictionHoldsComesToRest) {
  for (const double dt : {0.004, 0.02, 0.073}) EXPECT_LT(speed_left(0.02, dt), 2e-4) << dt;
}

TEST(Integrate, EvenTheSharpestFrictionDoesNotSpeedAJointUp) {
  for (const double dt : {0.004, 0.02, 0.073}) EXPECT_LT(speed_left(1e-4, dt), 0.05) << dt;
}

TEST(Integrate, ReturnsTheMiddleOfAShortStepAndTheStartOfALongOne) {
  FaultyScara smooth;
  smooth.fc = {0.0, 0.0, 0.0};
  const Twin twin(smooth);
  Fault fault = fault_of(FaultKind::torque_loss, 1, {0.4});
  fault.truth.fc = smooth.fc;
  const State start{{0.3, 0.8, -0.1}, {1.0, -0.7, 0.2}};
  const Triple torque = {15.0, -6.0, 30.0}, at_start = fault.truth.acceleration(start, torque),
               in_middle = fault.truth.acceleration(fault.truth.after(start, torque, 0.002), torque);
  for (const double dt : {0.004, 0.02}) {
    MotionState x = motion_of(start);
    const Acceleration at = twin.dynamics.integrate(x, joint_array(torque), dt, sized(fault));
    for (int j = 0; j < 3; ++j) {
      const double apart = std::abs(in_middle[j] - at_start[j]);
      if (dt > kShortStep_s)
        EXPECT_NEAR(at.value[j], at_start[j], 1e-9);
      else
        EXPECT_LT(std::abs(at.value[j] - in_middle[j]), 0.3 * apart);
    }
  }
}

TEST(StoppingImpulse, StopsTheJointAndKeepsTheMomentumOfTheOthers) {
  const Twin twin;
  const FaultyScara& r = twin.truth;
  const State x{{0.3, 0.8, -0.1}, {1.2, -0.7, 0.2}};
  const double a = r.l1 * r.l1 * (r.m1 / 3.0 + r.m2 + r.m3), b = r.l2 * r.l2 * (r.m2 / 3.0 + r.m3),
               c = r.l1 * r.l2 * (r.m2 / 2.0 + r.m3) * std::cos(x.q[1]);
  const double m[3][3] = {{a + b + 2.0 * c, b + c, 0.0}, {b + c, b, 0.0}, {0.0, 0.0, r.m3}};
  for (int stopped = 0; stopped < 3; ++stopped) {
    const JointArray change = twin.dynamics.stopping_impulse(motion_of(x), stopped);
    EXPECT_NEAR(x.dq[stopped] + change[stopped], 0.0, 1e-12);
    double energy_change = 0.0;
    for (int i = 0; i < 3; ++i) {
      double momentum_change = 0.0;
      for (int j = 0; j < 3; ++j) {
        momentum_change += m[i][j] * change[j];
        energy_change += m[i][j] * (x.dq[i] + 0.5 * change[i]) * change[j];
      }
      EXPECT_NEAR(i == stopped ? 0.0 : momentum_change, 0.0, 1e-12) << "joint " << i + 1;
    }
    EXPECT_LT(energy_change, 0.0) << "a stop takes energy";
  }
}

}  // namespace
}  // namespace faultline
