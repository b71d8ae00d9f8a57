// SPDX-License-Identifier: MIT
#include "lib/identify/motion/log_survey.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/log/log_source.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

using testing::simulate_closed_form;

LogSurvey survey(const Log& log) {
  MemorySource source(log, "log");
  return survey_log(source, 3);
}

void copy_row(Log& log, int to, int from) {
  for (JointSignals* signals : {&log.q, &log.dq, &log.tau})
    for (auto& channel : *signals) channel[to] = channel[from];
}

/// Every seventh row is a copy of the one before, written again while the time counted on.
Log with_rows_written_twice(const Log& log) {
  Log out = slice(log, 0, 0);
  double later = 0.0;
  for (int k = 0; k < log.rows(); ++k) {
    Log row = slice(log, k, k + 1);
    row.time[0] += later;
    append(out, row);
    if (k % 7 != 3) continue;
    later += 0.005;
    row.time[0] += 0.005;
    append(out, row);
  }
  return out;
}

TEST(LogSurvey, AHealthyLogHasNoRepeatedRowsAndAMeasuredVelocity) {
  const LogSurvey s = survey(simulate_closed_form({}, {}));
  EXPECT_EQ(s.repeated_rows, RepeatedRows::none);
  EXPECT_EQ(s.dq_is_derived, (std::vector<char>{0, 0, 0}));
  EXPECT_NEAR(s.summary.period_s, 0.005, 1e-12);
  EXPECT_NEAR(s.noise[0].q_std / 1e-4, 1.0, 0.25);
  EXPECT_TRUE(survey_issues(s).empty());
}

TEST(LogSurvey, StaleRowsAreDistinguishedFromRowsWrittenTwice) {
  Log stale = simulate_closed_form({}, {});
  for (int k = 5; k < stale.rows(); k += 7) copy_row(stale, k, k - 1);
  EXPECT_EQ(survey(stale).repeated_rows, RepeatedRows::stale);
  const LogSurvey twice = survey(with_rows_written_twice(simulate_closed_form({}, {})));
  EXPECT_EQ(twice.repeated_rows, RepeatedRows::extra);
  EXPECT_NEAR(twice.repeated_share, 0.125, 0.03);
  EXPECT_NE(survey_issues(twice).find("repeated_rows"), nullptr);
}

TEST(LogSurvey, TimeOfRowsWrittenTwiceIsRemoved) {
  const Log log = simulate_closed_form({}, {});
  MemorySource source(with_rows_written_twice(log), "log");
  int rows = 0;
  for_each_raw_stretch(source, 3, RepeatedRows::extra, [&](const RawStretch& s) {
    for (int k = 0; k < s.rows(); ++k, ++rows) {
      ASSERT_LT(rows, log.rows());
      EXPECT_NEAR(s.time[k], log.time[rows], 1e-9);
      EXPECT_EQ(s.q(0, k), log.q[0][rows]);
    }
  });
  EXPECT_EQ(rows, log.rows());
}

TEST(LogSurvey, VelocityComputedFromPositionsIsNotAMeasurement) {
  Log log = simulate_closed_form({}, {});
  for (int k = log.rows() - 1; k > 0; --k) log.dq[1][k] = (log.q[1][k] - log.q[1][k - 1]) / 0.005;
  const LogSurvey s = survey(log);
  EXPECT_EQ(s.dq_is_derived, (std::vector<char>{0, 1, 0}));
  EXPECT_NE(survey_issues(s).find("velocity_from_position"), nullptr);
}

TEST(LogSurvey, VelocityInAnotherUnitIsNamedAndLeftOut) {
  Log log = simulate_closed_form({}, {});
  for (double& v : log.dq[0]) v *= 57.29578;
  for (double& v : log.dq[2]) v = -v;
  const LogSurvey s = survey(log);
  EXPECT_FALSE(s.measures_velocity(0));
  EXPECT_TRUE(s.measures_velocity(1));
  EXPECT_FALSE(s.measures_velocity(2));
  const Issues issues = survey_issues(s);
  ASSERT_NE(issues.find("velocity_disagrees_1"), nullptr);
  EXPECT_NE(issues.find("velocity_disagrees_1")->message.find("the velocity seems to be in deg/s"),
            std::string::npos);
  EXPECT_NE(issues.find("velocity_disagrees_3")->message.find("the sign of one of them is wrong"),
            std::string::npos);
}

TEST(LogSurvey, TorqueAtALimitIsAWarningUnlessTheLimitIsKnown) {
  Log log = simulate_closed_form({}, {});
  double largest = 0.0;
  for (const double tau : log.tau[1]) largest = std::max(largest, std::abs(tau));
  for (double& tau : log.tau[1]) tau = std::clamp(tau, -0.4 * largest, 0.4 * largest);
  const LogSurvey s = survey(log);
  EXPECT_NE(survey_issues(s).find("torque_limit", "tau2"), nullptr);
  EXPECT_NE(survey_issues(s, {3.0}).find("torque_limit", "tau2"), nullptr) << "that of another joint";
  EXPECT_EQ(survey_issues(s, {0.0, 0.4 * largest}).find("torque_limit", "tau2"), nullptr);
}

TEST(RawStretch, LostRowsBecomeRowsWithoutMeasurementAndLongGapsSplitTheLog) {
  Log log = simulate_closed_form({}, {}), thinned = slice(log, 0, 0);
  for (int k = 0; k < log.rows(); ++k)
    if (k % 20 != 7 && (k < 300 || k >= 330)) append(thinned, slice(log, k, k + 1));
  MemorySource source(thinned, "log");
  int stretches = 0, stale = 0;
  for_each_raw_stretch(source, 3, RepeatedRows::none, [&](const RawStretch& s) {
    ++stretches;
    stale += s.stale.sum();
    for (int k = 1; k < s.rows(); ++k) EXPECT_NEAR(s.time[k] - s.time[k - 1], 0.005, 1e-9);
  });
  EXPECT_EQ(stretches, 2);
  EXPECT_NEAR(stale, (log.rows() - 30) / 20, 2);
}

}  // namespace
}  // namespace faultline
