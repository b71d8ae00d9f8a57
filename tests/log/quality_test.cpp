// SPDX-License-Identifier: MIT
#include "lib/log/quality.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

/// A clean log of one joint at 100 Hz with encoder noise.
Log clean_log(int rows = 2000) {
  Log log;
  Random random(7);
  log.q.resize(1);
  log.dq.resize(1);
  log.tau.resize(1);
  for (int i = 0; i < rows; ++i) {
    const double t = 0.01 * i;
    log.time.push_back(t);
    log.q[0].push_back(std::sin(2.0 * t) + 1e-4 * random.normal());
    log.dq[0].push_back(2.0 * std::cos(2.0 * t) + 5e-3 * random.normal());
    log.tau[0].push_back(-4.0 * std::sin(2.0 * t) + 0.1 * random.normal());
  }
  return log;
}

LogQuality quality_in(const Log& log, int segment_rows = 1 << 20) {
  QualityState state;
  for (int begin = 0; begin < log.rows(); begin += segment_rows)
    assess(slice(log, begin, std::min(begin + segment_rows, log.rows())), state);
  return quality_of(state);
}

void expect_issue(const LogQuality& quality, const char* code, const char* channel, const char* word) {
  const Issue* issue = quality.issues.find(code, channel);
  ASSERT_NE(issue, nullptr) << code;
  EXPECT_NE(issue->message.find(word), std::string::npos) << issue->message;
}

TEST(Quality, ACleanLogHasNoIssue) {
  const LogQuality quality = quality_in(clean_log());
  for (const Issue& issue : quality.issues.all()) ADD_FAILURE() << issue.code << ": " << issue.message;
  EXPECT_NEAR(quality.time.period_s, 0.01, 1e-12);
  EXPECT_NEAR(quality.time.end_s, 19.99, 1e-12);
  ASSERT_EQ(quality.channels.size(), 3u);
  EXPECT_NEAR(quality.channels[0].max, 1.0, 1e-2);
  EXPECT_EQ(quality.velocity.at(0).verdict, VelocityVerdict::agrees);
}

TEST(Quality, AGapIsFoundWithItsPlace) {
  Log log = clean_log();
  for (int i = 1200; i < log.rows(); ++i) log.time[i] += 0.5;
  const LogQuality quality = quality_in(log);
  expect_issue(quality, "time_gap", "t", "0.51");
  EXPECT_EQ(quality.issues.find("time_gap", "t")->first_row, 1200);
  EXPECT_EQ(quality.issues.find("time_gap", "t")->count, 1);
}

TEST(Quality, UnevenStepsAreJitter) {
  Log log = clean_log();
  for (int i = 0; i < log.rows(); i += 5) log.time[i] += 0.004;
  expect_issue(quality_in(log), "time_jitter", "t", "uneven");
}

TEST(Quality, MissingValuesAreCounted) {
  Log log = clean_log();
  for (int i = 100; i < 150; ++i) log.tau[0][i] = std::nan("");
  const LogQuality quality = quality_in(log);
  expect_issue(quality, "missing_values", "tau1", "missing");
  EXPECT_EQ(quality.issues.find("missing_values", "tau1")->count, 50);
  EXPECT_EQ(quality.issues.find("missing_values", "tau1")->first_row, 101);
}

TEST(Quality, AChannelWithoutAnyValueIsSevere) {
  Log log = clean_log();
  log.tau[0].assign(log.rows(), std::nan(""));
  const LogQuality quality = quality_in(log);
  expect_issue(quality, "missing_values", "tau1", "has no values");
  EXPECT_EQ(quality.issues.find("missing_values", "tau1")->severity, Severity::severe);
}

TEST(Quality, AConstantChannelIsFound) {
  Log log = clean_log();
  log.tau[0].assign(log.rows(), 3.0);
  expect_issue(quality_in(log), "constant_channel", "tau1", "3");
}

TEST(Quality, ATorqueAtItsLimitIsFound) {
  Log log = clean_log();
  for (double& tau : log.tau[0]) tau = std::min(tau, 2.5);
  expect_issue(quality_in(log), "saturated_channel", "tau1", "2.5");
}

TEST(Quality, VelocityInDegreesIsFound) {
  Log log = clean_log();
  for (double& dq : log.dq[0]) dq *= 180.0 / M_PI;
  expect_issue(quality_in(log), "velocity_contradicts_position", "dq1", "deg/s");
}

TEST(Quality, VelocityWithTheWrongSignIsFound) {
  Log log = clean_log();
  for (double& dq : log.dq[0]) dq = -dq;
  expect_issue(quality_in(log), "velocity_contradicts_position", "dq1", "sign");
}

TEST(Quality, VelocityOfAnotherJointIsFound) {
  Log log = clean_log();
  for (int i = 0; i < log.rows(); ++i) log.dq[0][i] = 2.0 * std::cos(7.3 * log.time[i]);
  expect_issue(quality_in(log), "velocity_contradicts_position", "dq1", "does not follow");
}

/// Two joints that move, the second at another rate.
Log log_of_two() {
  Log log = clean_log();
  log.q.push_back({}), log.dq.push_back({}), log.tau.push_back(log.tau[0]);
  for (const double t : log.time) {
    log.q[1].push_back(0.3 * std::sin(3.0 * t));
    log.dq[1].push_back(0.9 * std::cos(3.0 * t));
  }
  return log;
}

TEST(Quality, OneFactorForAllJointsIsAWrongSamplePeriod) {
  Log log = log_of_two();
  for (double& t : log.time) t *= 0.5;
  const LogQuality quality = quality_in(log);
  expect_issue(quality, "sample_period_contradicts_motion", "t", "0.01 s, not 0.005 s");
  expect_issue(quality, "sample_period_contradicts_motion", "t", "[log.columns] t");
  expect_issue(quality, "velocity_contradicts_position", "dq2", "sample period");
}

/// A joint that goes from 0 to `end` in ten seconds and, where it goes to and fro, back.
Log turning(double end, bool to_and_fro) {
  Log log;
  log.q.resize(1);
  Random random(9);
  for (int i = 0; i <= 2000; ++i) {
    const double way = to_and_fro ? 1.0 - std::abs(1.0 - i / 1000.0) : i / 2000.0;
    log.time.push_back(0.005 * i);
    log.q[0].push_back(end * way + 1e-4 * random.normal());
  }
  return log;
}

TEST(Quality, AStatedUnitOfAFarPositionIsAWarning) {
  Log log = turning(100.0, true);
  log.q_ref = log.q;
  QualityState state;
  assess(log, state);
  QualityOptions options;
  options.stated_units = {"q1"};
  const Issues stated = quality_of(state, options).issues, not_stated = quality_of(state).issues;
  for (const char* channel : {"q1", "q_ref1"}) {
    ASSERT_NE(stated.find("unit_implausible", channel), nullptr);
    EXPECT_EQ(stated.find("unit_implausible", channel)->severity, Severity::warning) << channel;
    EXPECT_EQ(not_stated.find("unit_implausible", channel)->severity, Severity::severe) << channel;
  }
}

TEST(Quality, AJointThatTurnsWithoutEndIsNotSurelyInDegrees) {
  const LogQuality on = quality_in(turning(100.0, false)), back = quality_in(turning(100.0, true)),
                   fast = quality_in(turning(1000.0, false));
  ASSERT_NE(on.issues.find("unit_implausible", "q1"), nullptr);
  EXPECT_EQ(on.issues.find("unit_implausible", "q1")->severity, Severity::warning);
  EXPECT_NE(on.issues.find("unit_implausible", "q1")->message.find("turns without end"), std::string::npos);
  EXPECT_EQ(back.issues.find("unit_implausible", "q1")->severity, Severity::severe);
  EXPECT_EQ(fast.issues.find("unit_implausible", "q1")->severity, Severity::severe) << "100 rad/s";
  EXPECT_EQ(quality_in(turning(12.5, true)).issues.find("unit_implausible", "q1"), nullptr) << "two turns";
}

TEST(Quality, AClockOrPositionsScaledByAPercentAreFoundWithTheFactor) {
  EXPECT_EQ(quality_in(log_of_two()).issues.find(kScaledMotion), nullptr);
  Log log = log_of_two();
  for (double& t : log.time) t *= 1.01;
  expect_issue(quality_in(log), kScaledMotion, "", "t = {scale = 0.990");
  log = log_of_two();
  for (auto& q : log.q)
    for (double& value : q) value *= 1.01;
  expect_issue(quality_in(log), kScaledMotion, "", "change 1.01");
}

TEST(Quality, ADriftingPositionOfOneJointIsNotAScaledClock) {
  Log log = log_of_two();
  for (double& value : log.q[1]) value *= 1.01;
  EXPECT_EQ(quality_in(log).issues.find(kScaledMotion), nullptr);
}

TEST(Quality, TimeInMillisecondsIsNotReportedAsVelocityInMillimetres) {
  Log log = log_of_two();
  for (double& t : log.time) t *= 1000.0;
  expect_issue(quality_in(log), "sample_period_contradicts_motion", "t", "in ms");
  log = clean_log();
  for (double& t : log.time) t *= 1000.0;
  expect_issue(quality_in(log), "velocity_contradicts_position", "dq1", "the time seems to be in ms");
}

TEST(Quality, JointsWithDifferentFactorsAreNotAWrongSamplePeriod) {
  Log log = log_of_two();
  for (double& dq : log.dq[0]) dq *= 2.0;
  for (double& dq : log.dq[1]) dq *= 3.0;
  EXPECT_EQ(quality_in(log).issues.find("sample_period_contradicts_motion", "t"), nullptr);
  log = log_of_two();
  for (auto& dq : log.dq)
    for (double& value : dq) value *= 180.0 / M_PI;
  EXPECT_EQ(quality_in(log).issues.find("sample_period_contradicts_motion", "t"), nullptr);
  expect_issue(quality_in(log), "velocity_contradicts_position", "dq2", "deg/s");
}

TEST(Quality, TheSuspectedUnitIsMillimetresForASlidingAndDegreesForATurningAxis) {
  Log log = clean_log();
  for (double& q : log.q[0]) q *= 1000.0;
  QualityState state;
  assess(log, state);
  QualityOptions options;
  options.slides = {true};
  expect_issue(quality_of(state, options), "unit_implausible", "q1", "unit = \"mm\"");
  EXPECT_EQ(quality_of(state, options).issues.find("unit_implausible", "q1")->message.find("deg"),
            std::string::npos);
  options.slides = {false};
  expect_issue(quality_of(state, options), "unit_implausible", "q1", "unit = \"deg\"");
  expect_issue(quality_of(state), "unit_implausible", "q1", "mm (a sliding one)");
}

TEST(Quality, AJointAtRestIsNotJudgedByItsNoise) {
  Log log = clean_log();
  Random random(3);
  for (int i = 0; i < log.rows(); ++i)
    log.q[0][i] = 1e-4 * random.normal(), log.dq[0][i] = 5e-3 * random.normal();
  EXPECT_EQ(quality_in(log).velocity.at(0).verdict, VelocityVerdict::not_judged);
}

TEST(Quality, PositionInDegreesIsImplausible) {
  Log log = clean_log();
  for (double& q : log.q[0]) q *= 180.0 / M_PI;
  expect_issue(quality_in(log), "unit_implausible", "q1", "deg");
}

TEST(Quality, TimeInMillisecondsIsImplausible) {
  Log log = clean_log();
  for (double& t : log.time) t *= 1000.0;
  expect_issue(quality_in(log), "unit_implausible", "t", "ms");
}

TEST(Quality, BordersOfSegmentsChangeNothing) {
  Log log = clean_log(9000);
  for (int i = 6000; i < log.rows(); ++i) log.time[i] += 0.5;
  for (int i = 0; i < log.rows(); i += 7) log.time[i] += 0.003;
  for (int i = 0; i < log.rows(); i += 11) log.tau[0][i] = std::nan("");
  for (double& dq : log.dq[0]) dq *= 1.5;
  const LogQuality whole = quality_in(log);
  ASSERT_GE(whole.issues.all().size(), 4u);
  for (const int rows : {1, 7, 4096}) {
    const LogQuality parts = quality_in(log, rows);
    EXPECT_EQ(parts.time.period_s, whole.time.period_s);
    EXPECT_EQ(parts.time.jitter_s, whole.time.jitter_s);
    EXPECT_EQ(parts.velocity[0].factor, whole.velocity[0].factor);
    ASSERT_EQ(parts.issues.all().size(), whole.issues.all().size());
    for (std::size_t i = 0; i < whole.issues.all().size(); ++i) {
      EXPECT_EQ(parts.issues.all()[i].message, whole.issues.all()[i].message);
      EXPECT_EQ(parts.issues.all()[i].first_row, whole.issues.all()[i].first_row);
      EXPECT_EQ(parts.issues.all()[i].count, whole.issues.all()[i].count);
    }
  }
}

}  // namespace
}  // namespace faultline
