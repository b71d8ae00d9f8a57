// SPDX-License-Identifier: MIT
#include "lib/plausibility/checkup/checkup.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

constexpr double kPeriod_s = 0.01;
constexpr double kInertia = 3.0;

/// One joint at 100 Hz, inertia 3, with noise; its motion has many frequencies.
Log healthy_log(int rows = 4000) {
  Log log;
  Random random(11);
  log.q.resize(1), log.dq.resize(1), log.tau.resize(1);
  for (int i = 0; i < rows; ++i) {
    const double t = kPeriod_s * i;
    log.time.push_back(t);
    log.q[0].push_back(std::sin(3.0 * t) + 0.2 * std::sin(11.0 * t) + 1e-5 * random.normal());
    log.dq[0].push_back(3.0 * std::cos(3.0 * t) + 2.2 * std::cos(11.0 * t) + 1e-3 * random.normal());
    log.tau[0].push_back(-kInertia * (9.0 * std::sin(3.0 * t) + 24.2 * std::sin(11.0 * t)) +
                         0.1 * random.normal());
  }
  return log;
}

struct CheckedLog {
  CheckupResult checkup;
  Issues issues;
};

CheckedLog checked(const Log& log, int segment_rows = 1 << 20) {
  Checkup checkup;
  QualityState state;
  for (int begin = 0; begin < log.rows(); begin += segment_rows) {
    const Log segment = slice(log, begin, std::min(begin + segment_rows, log.rows()));
    checkup.add(segment);
    assess(segment, state);
  }
  return {checkup.result(), checkup_issues(checkup.result(), quality_of(state))};
}

const ChannelCourse::Result& course(const CheckedLog& log, Quantity quantity) {
  return log.checkup.find({quantity, 1_joint})->course;
}

/// The values some rows later.
std::vector<double> late(const std::vector<double>& values, int rows) {
  std::vector<double> result(values.size());
  for (int i = 0; i < std::ssize(values); ++i) result[i] = values[std::max(i - rows, 0)];
  return result;
}

TEST(Checkup, AHealthyLogHasNoIssue) {
  const CheckedLog found = checked(healthy_log());
  for (const Issue& issue : found.issues.all()) ADD_FAILURE() << issue.code << ": " << issue.message;
  const JointCheckup& joint = found.checkup.joints.at(0);
  EXPECT_NEAR(joint.velocity.rms_ratio, 1.0, 0.01);
  EXPECT_NEAR(joint.velocity.delay_rows, 0.0, 0.1);
  EXPECT_FALSE(joint.velocity.is_difference);
  EXPECT_GT(joint.torque.correlation, 0.99);
  EXPECT_NEAR(joint.torque.delay_rows, 0.0, 0.2);
  EXPECT_NEAR(joint.torque.inertia, kInertia, 0.1);
  EXPECT_FALSE(course(found, Quantity::q).step.has_value());
}

TEST(Checkup, AStuckEncoderIsFoundWithItsPlace) {
  Log log = healthy_log();
  for (int i = 1000; i < 1300; ++i) log.q[0][i] = log.q[0][1000];
  const CheckedLog found = checked(log);
  ASSERT_NE(found.issues.find("stuck_channel", "q1"), nullptr);
  EXPECT_DOUBLE_EQ(found.issues.find("stuck_channel", "q1")->first_time_s, log.time[1000]);
  EXPECT_EQ(course(found, Quantity::q).while_moving.rows, 300);
}

TEST(Checkup, AStuckVelocityIsFound) {
  Log log = healthy_log();
  for (int i = 1000; i < 1300; ++i) log.dq[0][i] = log.dq[0][1000];
  EXPECT_NE(checked(log).issues.find("stuck_channel", "dq1"), nullptr);
}

TEST(Checkup, AStuckTorqueIsFoundAndOneAtItsLimitIsNot) {
  Log log = healthy_log();
  for (int i = 1000; i < 1300; ++i) log.tau[0][i] = 7.0;
  EXPECT_NE(checked(log).issues.find("stuck_channel", "tau1"), nullptr);
  log = healthy_log();
  for (double& tau : log.tau[0]) tau = std::min(tau, 7.0);
  EXPECT_EQ(checked(log).issues.find("stuck_channel", "tau1"), nullptr);
}

TEST(Checkup, AJointAtRestIsNotStuck) {
  Log log = healthy_log();
  for (int i = 1000; i < 3000; ++i) log.q[0][i] = log.q[0][1000], log.dq[0][i] = 0.0, log.tau[0][i] = 7.0;
  const CheckedLog found = checked(log);
  EXPECT_EQ(found.issues.find("stuck_channel", "q1"), nullptr);
  EXPECT_EQ(found.issues.find("stuck_channel", "dq1"), nullptr);
  EXPECT_EQ(found.issues.find("stuck_channel", "tau1"), nullptr);
  EXPECT_EQ(course(found, Quantity::q).longest.rows, 2000);
}

TEST(Checkup, TheLongestStretchAtALimitIsFound) {
  Log log = healthy_log();
  for (double& tau : log.tau[0]) tau = std::max(tau, -20.0);
  int now = 0, longest = 0;
  for (const double tau : log.tau[0]) longest = std::max(longest, now = tau == -20.0 ? now + 1 : 0);
  ASSERT_GT(longest, 10);
  const CheckedLog found = checked(log);
  EXPECT_EQ(course(found, Quantity::tau).at_min.rows, longest);
  EXPECT_EQ(course(found, Quantity::tau).at_max.rows, 1);
}

TEST(Checkup, TheStepOfAQuantisedChannelIsFound) {
  Log log = healthy_log();
  for (double& q : log.q[0]) q = 0.0125 * std::round(q / 0.0125);
  const CheckedLog found = checked(log);
  ASSERT_TRUE(course(found, Quantity::q).step.has_value());
  EXPECT_NEAR(*course(found, Quantity::q).step, 0.0125, 1e-6);
}

TEST(Checkup, AVelocityThatStaysZeroIsFoundButAJointAtRestIsNot) {
  Log log = healthy_log();
  log.dq[0].assign(log.rows(), 0.0);
  EXPECT_EQ(checked(log).checkup.joints[0].velocity.rms_ratio, 0.0);
  Random random(2);
  for (int i = 0; i < log.rows(); ++i)
    log.q[0][i] = 1e-4 * random.normal(), log.dq[0][i] = 1e-5 * random.normal();
  EXPECT_TRUE(std::isnan(checked(log).checkup.joints[0].velocity.rms_ratio));
}

TEST(Checkup, AVelocityComputedFromThePositionIsRecognised) {
  Log log = healthy_log();
  for (int i = 1; i < log.rows(); ++i) log.dq[0][i] = (log.q[0][i] - log.q[0][i - 1]) / kPeriod_s;
  const CheckedLog found = checked(log);
  EXPECT_TRUE(found.checkup.joints[0].velocity.is_difference);
  EXPECT_NEAR(found.checkup.joints[0].velocity.delay_rows, 0.5, 0.1);
}

TEST(Checkup, ALateVelocityIsFound) {
  Log log = healthy_log();
  log.dq[0] = late(log.dq[0], 3);
  const CheckedLog found = checked(log);
  EXPECT_NEAR(found.checkup.joints[0].velocity.delay_rows, 3.0, 0.2);
  EXPECT_NE(found.issues.find("velocity_late", "dq1"), nullptr);
}

TEST(Checkup, ATorqueOfTheWrongSignIsFound) {
  Log log = healthy_log();
  for (double& tau : log.tau[0]) tau = -tau;
  const CheckedLog found = checked(log);
  ASSERT_NE(found.issues.find("torque_against_acceleration", "tau1"), nullptr);
  EXPECT_NE(found.issues.all()[0].message.find("tau1 = {sign = -1}"), std::string::npos);
}

TEST(Checkup, ATorqueFarTooLateIsFound) {
  Log log = healthy_log();
  log.tau[0] = late(log.tau[0], 5);
  const CheckedLog found = checked(log);
  EXPECT_NEAR(found.checkup.joints[0].torque.delay_rows, 5.0, 0.4);
  EXPECT_NE(found.issues.find("torque_delayed", "tau1"), nullptr);
}

TEST(Checkup, APermanentChangeOfTheClockIsFoundWithItsPlace) {
  Log log = healthy_log();
  for (int i = 2000; i < log.rows(); ++i) log.time[i] += 0.5 * kPeriod_s * (i - 1999);
  const CheckedLog found = checked(log);
  ASSERT_EQ(found.checkup.clock_changes.size(), 1u);
  EXPECT_NEAR(found.checkup.clock_changes[0].at_s, 20.0, 0.7);
  EXPECT_NEAR(found.checkup.clock_changes[0].after_s, 1.5 * kPeriod_s, 1e-3);
  EXPECT_NE(found.issues.find("clock_change", "t"), nullptr);
}

TEST(Checkup, GapsAndJitterAreNotAChangeOfTheClock) {
  Log log = healthy_log();
  for (int i = 2000; i < log.rows(); ++i) log.time[i] += 3.0;
  for (int i = 0; i < log.rows(); i += 3) log.time[i] += 0.4 * kPeriod_s;
  EXPECT_TRUE(checked(log).checkup.clock_changes.empty());
}

TEST(Checkup, RowsOfASlowerSourceAreFoundAndThoseOfARobotAtRestAreNot) {
  Log log = healthy_log();
  for (int i = 0; i < log.rows(); ++i)
    for (auto* signals : {&log.q, &log.dq, &log.tau}) (*signals)[0][i] = (*signals)[0][i / 4 * 4];
  const CheckedLog found = checked(log);
  EXPECT_EQ(found.checkup.repeated.all.held, 3000);
  EXPECT_NE(found.issues.find("rows_repeated"), nullptr);
  log = healthy_log();
  for (int i = 1000; i < 3000; ++i) log.q[0][i] = log.q[0][1000], log.dq[0][i] = 0.0, log.tau[0][i] = 0.0;
  const CheckedLog rest = checked(log);
  EXPECT_EQ(rest.checkup.repeated.all.longest, 1999);
  EXPECT_EQ(rest.checkup.repeated.all.held, 0);
  EXPECT_EQ(rest.issues.find("rows_repeated"), nullptr);
}

TEST(Checkup, PositionsReadLessOftenThanTorquesAreFoundButCoarseEncodersAreNot) {
  Log two = healthy_log();
  for (JointSignals* signals : {&two.q, &two.dq, &two.tau}) {
    signals->push_back((*signals)[0]);
    for (double& value : signals->back()) value *= 0.37;
  }
  Log log = two;
  for (auto& q : log.q)
    for (int i = 0; i < log.rows(); ++i) q[i] = q[i / 4 * 4];
  const CheckedLog found = checked(log);
  EXPECT_EQ(found.issues.find("rows_repeated"), nullptr);
  const Issue* issue = found.issues.find("positions_repeated");
  ASSERT_NE(issue, nullptr);
  EXPECT_EQ(issue->first_row, 2);
  EXPECT_NE(issue->message.find("75.0 %"), std::string::npos);
  for (auto& q : two.q)
    for (double& value : q) value = 0.003 * std::round(value / 0.003);
  EXPECT_EQ(checked(two).issues.find("positions_repeated"), nullptr);
}

TEST(Checkup, AVelocityFarFromTheChangeOfThePositionIsReported) {
  Log log = healthy_log();
  EXPECT_EQ(checked(log).issues.find("velocity_off", "dq1"), nullptr);
  for (double& dq : log.dq[0]) dq *= 0.78;
  const CheckedLog found = checked(log);
  const Issue* issue = found.issues.find("velocity_off", "dq1");
  ASSERT_NE(issue, nullptr);
  EXPECT_NE(issue->message.find("times as large"), std::string::npos);
}

TEST(Checkup, TimeStampsThatAreFarTooCloseAreReported) {
  Log log = healthy_log();
  for (double& t : log.time) t *= 1e-6;
  EXPECT_NE(checked(log).issues.find("unit_implausible", "t"), nullptr);
}

TEST(Checkup, CompletenessCountsTheRowsThatAreMissingInAGap) {
  Log log = healthy_log();
  for (int i = 3000; i < log.rows(); ++i) log.time[i] += 1000 * kPeriod_s;
  QualityState state;
  assess(log, state);
  EXPECT_NEAR(completeness(quality_of(state).time), 0.8, 1e-3);
  EXPECT_EQ(quality_of(state).time.listed_gaps.size(), 1u);
  QualityState whole;
  assess(healthy_log(), whole);
  EXPECT_DOUBLE_EQ(completeness(quality_of(whole).time), 1.0);
}

TEST(Checkup, BordersOfSegmentsChangeNothing) {
  Log log = healthy_log();
  for (int i = 2000; i < log.rows(); ++i) log.time[i] += 0.3;
  for (int i = 500; i < 520; ++i) log.q[0][i] = std::nan("");
  const CheckedLog whole = checked(log);
  for (const int rows : {1, 63, 4096}) {
    const CheckedLog parts = checked(log, rows);
    const JointCheckup &a = whole.checkup.joints[0], &b = parts.checkup.joints[0];
    EXPECT_EQ(a.velocity.delay_rows, b.velocity.delay_rows);
    EXPECT_EQ(a.velocity.rms, b.velocity.rms);
    EXPECT_EQ(a.torque.correlation, b.torque.correlation);
    EXPECT_EQ(course(whole, Quantity::q).longest.start_s, course(parts, Quantity::q).longest.start_s);
  }
}

TEST(Checkup, ALogOfThreeRowsIsNotJudged) {
  const CheckedLog found = checked(healthy_log(3));
  EXPECT_TRUE(found.issues.empty());
  EXPECT_TRUE(std::isnan(found.checkup.joints[0].velocity.rms_ratio));
  EXPECT_TRUE(std::isnan(found.checkup.joints[0].torque.correlation));
}

}  // namespace
}  // namespace faultline
