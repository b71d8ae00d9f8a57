// SPDX-License-Identifier: MIT
// Joints that stand between motions, where static friction takes any torque.
#include "lib/balance/rest.hpp"

#include <gtest/gtest.h>

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

TEST(Stiction, IsFoundInHealthyLogsAndDoesNotBendTheRobot) {
  const ClosedFormScara truth;
  const BalanceModel& m = sticking_model();
  for (int j = 0; j < 2; ++j) {
    EXPECT_GT(m.stiction[j], 0.9 * truth.fc[j]) << j;
    EXPECT_LT(m.stiction[j], 2.0 * truth.fc[j]) << j;
    EXPECT_NEAR(m.theta[m.layout().coulomb(j)] / truth.fc[j], 1.0, 0.1) << j;
  }
  EXPECT_EQ(m.stiction[2], 0.0);
}

TEST(Stiction, IsNotFoundWhereFrictionBySpeedExplainsTheRobotAtRest) {
  EXPECT_TRUE(testing::scara_model().stiction.isZero(0.0));
}

TEST(Stiction, ATorqueWithinItIsNoFault) {
  const UniformLog healthy = on_grid(with_rest(simulate_closed_form(of_day(1), run_of(21)), -0.9));
  EXPECT_TRUE(explain_faults(healthy, sticking_model(), evidence_limits({})).faults.empty());
}

TEST(Stiction, ATorqueFarBeyondItIsAFault) {
  const UniformLog held = on_grid(with_rest(simulate_closed_form(of_day(1), run_of(21)), 6.0));
  EXPECT_FALSE(explain_faults(held, sticking_model(), evidence_limits({})).faults.empty());
}

TEST(RestingRows, AreThoseOfAJointThatStandsAndNotOfOneThatTurnsBack) {
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

}  // namespace
}  // namespace faultline
