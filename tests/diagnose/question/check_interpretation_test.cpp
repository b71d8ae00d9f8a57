// SPDX-License-Identifier: MIT
#include "lib/diagnose/question/check_interpretation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>

#include "lib/log/log_source.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

constexpr double kPeriod_s = 0.01;
constexpr double kDegrees = 180.0 / std::numbers::pi;

LogMismatch doubt_of(const Log& log) {
  MemorySource source(log);
  const Robot rrp = known_rrp();
  const KnownRobot robot{rrp, rrp_usual_motion()};
  const LogMismatch clock = check_clock(source, robot, kPeriod_s);
  return clock.is_empty() ? check_interpretation(source, robot) : clock;
}

Log healthy(std::uint64_t seed = 71) { return simulate(known_rrp(), rrp_run(10.0), seed).log; }

Log collision() {
  return simulate(known_rrp(), rrp_run_with(FaultKind::collision, 2_joint, 3.0, 20.0, 0.3), 73).log;
}

void scale(std::vector<double>& values, double by) {
  for (double& v : values) v *= by;
}

void scale_joint(Log& log, int j, double by) {
  scale(log.q[j], by);
  scale(log.dq[j], by);
}

struct WrongReading {
  const char* cause;  ///< that must stand in what is said
  std::function<void(Log&)> change;
};

std::vector<WrongReading> wrong_readings() {
  return {{"angles are in degrees",
           [](Log& log) {
             scale_joint(log, 0, kDegrees);
             scale_joint(log, 1, kDegrees);
           }},
          {"q2 and dq2 are in deg", [](Log& log) { scale_joint(log, 1, kDegrees); }},
          {"sliding axes are in mm", [](Log& log) { scale_joint(log, 2, 1e3); }},
          {"velocities of the turning axes are in deg/s",
           [](Log& log) {
             scale(log.dq[0], kDegrees);
             scale(log.dq[1], kDegrees);
           }},
          {"1000 times too large",
           [](Log& log) {
             for (auto& tau : log.tau) scale(tau, 1e3);
           }},
          {"current",
           [](Log& log) {
             scale(log.tau[0], 0.3);
             scale(log.tau[1], 0.5);
             scale(log.tau[2], 0.08);
           }},
          {"time is in milliseconds", [](Log& log) { scale(log.time, 1e3); }},
          {"joints 1 and 2 are swapped",
           [](Log& log) {
             std::swap(log.q[0], log.q[1]);
             std::swap(log.dq[0], log.dq[1]);
             std::swap(log.tau[0], log.tau[1]);
           }},
          {"joint 3 counts in the opposite direction",
           [](Log& log) {
             scale_joint(log, 2, -1.0);
             scale(log.tau[2], -1.0);
           }},
          {"tau1 and tau2 are swapped", [](Log& log) { std::swap(log.tau[0], log.tau[1]); }},
          {"tau2 has the opposite sign", [](Log& log) { scale(log.tau[1], -1.0); }},
          {"q1 and dq1 have the opposite sign", [](Log& log) { scale_joint(log, 0, -1.0); }},
          {"too late",
           [](Log& log) {
             for (auto& tau : log.tau) std::rotate(tau.rbegin(), tau.rbegin() + 20, tau.rend());
           }},
          {"time runs 1.5 times", [](Log& log) { scale(log.time, 1.5); }}};
}

TEST(InterpretationCheck, FindsNothingInAHealthyLogOrALogWithALaterFault) {
  for (const Log& log : {healthy(), healthy(72), collision()})
    EXPECT_TRUE(doubt_of(log).is_empty()) << doubt_of(log).what;
}

TEST(InterpretationCheck, NamesAWrongInterpretationOfAHealthyLog) {
  for (const WrongReading& wrong : wrong_readings()) {
    Log log = healthy();
    wrong.change(log);
    const LogMismatch doubt = doubt_of(log);
    EXPECT_NE(doubt.what.find(wrong.cause), std::string::npos) << wrong.cause << ": said " << doubt.what;
    EXPECT_NE(doubt.cure, "");
  }
}

TEST(InterpretationCheck, NamesAWrongInterpretationOfAFaultyLog) {
  const std::vector<WrongReading> all = wrong_readings();
  for (std::size_t i = 0; i < all.size(); i += 3) {
    const WrongReading& wrong = all[i];
    Log log = collision();
    wrong.change(log);
    const LogMismatch doubt = doubt_of(log);
    EXPECT_NE(doubt.what.find(wrong.cause), std::string::npos) << wrong.cause << ": said " << doubt.what;
  }
}

TEST(InterpretationCheck, AJumpOfAPositionIsNotAWrongInterpretationOfItsVelocity) {
  Log log = healthy();
  for (int k = 250; k < log.rows(); ++k) log.q[2][k] += 0.02;
  EXPECT_TRUE(doubt_of(log).is_empty()) << doubt_of(log).what;
}

TEST(InterpretationCheck, AFaultOfOneJointFromTheFirstRowOnIsNotAWrongInterpretation) {
  for (const auto& [kind, joint, size] :
       {std::tuple{FaultKind::torque_loss, 1_joint, 0.6},
        std::tuple{FaultKind::friction_increase, 2_joint, 5.0},
        std::tuple{FaultKind::sensor_bias, 1_joint, 0.1}, std::tuple{FaultKind::locked, 2_joint, 0.0},
        std::tuple{FaultKind::payload_change, 3_joint, 2.0}}) {
    const Log log = simulate(known_rrp(), rrp_run_with(kind, joint, 0.02, size), 74).log;
    EXPECT_TRUE(doubt_of(log).is_empty()) << to_string(kind) << ": " << doubt_of(log).what;
  }
}

TEST(InterpretationCheck, ALogOfAnotherRobotIsReported) {
  Robot other = preset_robot("RRP");
  other = with_masses_and_lengths(other, {2.0, 1.0, 0.5}, {0.2, 0.15, 0.0});
  const LogMismatch doubt = doubt_of(simulate(other, rrp_run(10.0), 75).log);
  EXPECT_FALSE(doubt.is_empty());
}

TEST(InterpretationCheck, FindsNothingInALogWithoutMotionOrTorque) {
  Log still = healthy();
  for (int j = 0; j < 3; ++j) {
    std::fill(still.q[j].begin(), still.q[j].end(), 0.2);
    std::fill(still.dq[j].begin(), still.dq[j].end(), 0.0);
  }
  EXPECT_TRUE(doubt_of(still).is_empty());
  Log without = healthy();
  without.tau.clear();
  EXPECT_TRUE(doubt_of(without).is_empty());
  EXPECT_TRUE(doubt_of(slice(healthy(), 0, 5)).is_empty());
}

}  // namespace
}  // namespace faultline
