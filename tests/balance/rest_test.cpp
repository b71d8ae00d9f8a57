// SPDX-License-Identifier: MIT
// Joints that stand between motions, where static friction takes any torque, or at an end stop.
#include "lib/balance/rest.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/explain/explain_faults.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::ClosedFormScara;
using testing::learned_from;
using testing::of_day;
using testing::on_grid;
using testing::run_of;
using testing::simulate_closed_form;

constexpr double kPause_s = 0.3;  // without rows, so that no kernel joins motion and rest
constexpr int kRows = 500;        // at rest

/// Appends rows in which the robot stands, with this share of each horizontal joint's static friction as
/// torque.
Log with_rest(Log log, double share) {
  const ClosedFormScara robot;
  const int last = log.rows() - 1;
  double weight = 0.0;
  for (int k = 0; k <= last; ++k) weight += log.tau[2][k] / (last + 1);
  for (int k = 0; k < kRows; ++k) {
    log.time.push_back(log.time[last] + kPause_s + k * testing::kExplainedPeriod_s);
    for (int j = 0; j < 3; ++j) {
      log.q[j].push_back(log.q[j][last]);
      log.dq[j].push_back(0.0);
      log.tau[j].push_back(j < 2 ? share * robot.fc[j] : weight);
    }
  }
  return log;
}

/// Learned from three days, at the end of each of which static friction holds the robot.
const BalanceModel& sticking_model() {
  static const BalanceModel learned = [] {
    std::vector<Log> days;
    const double share[] = {0.9, -0.8, 0.85};
    for (int day = 0; day < 3; ++day)
      days.push_back(with_rest(simulate_closed_form(of_day(day), run_of(day + 1)), share[day]));
    return learned_from(days).model;
  }();
  return learned;
}

TEST(Stiction, IsFoundInHealthyLogsAndDoesNotBiasTheIdentifiedFriction) {
  const ClosedFormScara truth;
  const BalanceModel& m = sticking_model();
  for (int j = 0; j < 2; ++j) {
    EXPECT_GT(m.stiction[j], 0.9 * truth.fc[j]) << j;
    EXPECT_LT(m.stiction[j], 2.0 * truth.fc[j]) << j;
    EXPECT_NEAR(m.theta[m.layout().coulomb(j)] / truth.fc[j], 1.0, 0.1) << j;
  }
  EXPECT_EQ(m.stiction[2], 0.0);
}

TEST(Stiction, IsNotFoundIfFrictionBySpeedExplainsTheRobotAtRest) {
  EXPECT_TRUE(testing::scara_model().stiction.isZero(0.0));
}

TEST(Stiction, ATorqueWithinStictionIsNotAFault) {
  const UniformLog healthy = on_grid(with_rest(simulate_closed_form(of_day(1), run_of(21)), -0.9));
  EXPECT_TRUE(explain_faults(healthy, sticking_model(), evidence_limits({})).faults.empty());
}

TEST(Stiction, ATorqueFarBeyondStictionIsAFault) {
  const UniformLog held = on_grid(with_rest(simulate_closed_form(of_day(1), run_of(21)), 6.0));
  EXPECT_FALSE(explain_faults(held, sticking_model(), evidence_limits({})).faults.empty());
}

TEST(RestingRows, IncludeAJointAtRestButNotAJointThatReverses) {
  BalanceRows rows;
  rows.time_s = Eigen::VectorXd::LinSpaced(12, 0.0, 1.1);
  rows.torque = Eigen::MatrixXd::Zero(12, 2);
  rows.dq = Eigen::MatrixXd::Constant(12, 2, 1.0);
  rows.dq.col(0).segment(4, 4).setConstant(0.001);
  rows.dq.col(1).segment(4, 2) << 0.005, -0.005;
  const JointMask rests = resting_rows(rows, Eigen::Vector2d(0.01, 0.01));
  for (int k = 0; k < 12; ++k) EXPECT_EQ(rests(k, 0), k >= 3 && k <= 8) << k;
  EXPECT_FALSE(rests.col(1).any());
}

/// The slide falls from `falls_s` on through the end of its range, hits a stop at `hits_s`, bounces for
/// `bounces_s` and stays there.
UniformLog falling(double falls_s, double hits_s, double bounces_s) {
  UniformLog log = on_grid(simulate_closed_form(of_day(0), run_of(31)));
  const auto row_of = [&](double t) { return static_cast<int>(std::lround(t / log.period_s)); };
  const double from = log.q(row_of(falls_s), 2), fall = hits_s - falls_s,
               stop = from - 0.5 * 9.81 * fall * fall;
  for (int k = row_of(falls_s); k < log.rows(); ++k) {
    const double since = log.time_s(k) - falls_s, after = log.time_s(k) - hits_s;
    if (after < 0.0) {
      log.q(k, 2) = from - 0.5 * 9.81 * since * since;
      log.dq(k, 2) = -9.81 * since;
    } else {
      const double share = after < bounces_s ? 1.0 - after / bounces_s : 0.0, w = 60.0;
      log.q(k, 2) = stop + 0.025 * share * std::abs(std::sin(w * after));
      log.dq(k, 2) = 1.5 * share * std::cos(w * after);
    }
  }
  return log;
}

double first_stopped_s(const UniformLog& log) {
  const BalanceModel& m = testing::scara_model();
  const BalanceRows rows = balance_rows(log, m.setting, m.rigid, m.theta);
  const Eigen::MatrixXd std = stop_std(rows, m);
  for (int k = 0; k < rows.rows(); ++k)
    if (std(k, 2) > 0.0) return rows.time_s[k];
  return -1.0;
}

TEST(EndStop, RowsAreSilentFromTheFirstStopOnAlsoIfTheJointBounces) {
  for (const double bounces_s : {0.02, 0.28})
    EXPECT_NEAR(first_stopped_s(falling(4.0, 4.3, bounces_s)), 4.3, 0.06) << bounces_s;
}

TEST(EndStop, AMovingJointIsHeldByNoEndStop) {
  EXPECT_EQ(first_stopped_s(on_grid(simulate_closed_form(of_day(0), run_of(31)))), -1.0);
}

constexpr double kLimit = 60.0;  // N m: of the drive of joint 1

/// A day on which more is commanded than the drive of joint 1 gives.
Log clipped_day(int day, const ClosedFormScara& robot) {
  testing::ClosedFormRun run = run_of(day + 1);
  run.clips_from_s = 0.0;
  run.clip = {kLimit, 1e9, 1e9};
  return simulate_closed_form(robot, run);
}

/// Learned from three such days.
const BalanceModel& clipped_model() {
  static const BalanceModel learned = [] {
    std::vector<Log> days;
    for (int day = 0; day < 3; ++day) days.push_back(clipped_day(day, of_day(day)));
    return learned_from(days).model;
  }();
  return learned;
}

TEST(DriveLimit, IsFoundInHealthyLogsAndDoesNotBiasTheRobot) {
  const ClosedFormScara truth;
  const BalanceModel& m = clipped_model();
  EXPECT_NEAR(m.drive_limit[0], kLimit, 0.02 * kLimit);
  EXPECT_EQ(m.drive_limit[1], 0.0);
  EXPECT_EQ(m.drive_limit[2], 0.0);
  EXPECT_NEAR(m.theta[m.layout().coulomb(0)], truth.fc[0], 0.1 * truth.fc[0]);
}

TEST(DriveLimit, ACommandBeyondItIsNoFault) {
  const UniformLog day = on_grid(clipped_day(11, of_day(1)));
  EXPECT_TRUE(explain_faults(day, clipped_model(), evidence_limits({})).faults.empty());
  BalanceModel without = clipped_model();
  without.drive_limit.setZero();
  EXPECT_FALSE(explain_faults(day, without, evidence_limits({})).faults.empty());
}

}  // namespace
}  // namespace faultline
