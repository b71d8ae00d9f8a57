// SPDX-License-Identifier: MIT
#include "lib/log/columns/counted_time.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/formats/read_csv.hpp"

namespace faultline {
namespace {

/// Counts from `first` on by `step`.
std::vector<double> counts(double first, double step) {
  std::vector<double> time;
  for (int k = 0; k < 100; ++k) time.push_back(first + step * k);
  return time;
}

/// A joint whose velocity is the derivative of its position when a count is `seconds`.
std::vector<NamedValues> joint_of(const std::vector<double>& time, double seconds) {
  NamedValues q{"q1", {}}, dq{"dq1", {}};
  for (const double t : time) {
    const double at = seconds * (t - time.front());
    q.values.push_back(std::sin(3.0 * at));
    dq.values.push_back(3.0 * std::cos(3.0 * at));
  }
  return {q, dq};
}

std::string unit_of(const std::vector<double>& time, const std::vector<NamedValues>& columns = {}) {
  return counted_time(time, columns).unit;
}

TEST(CountedTime, AMicrosecondCounterOfSomeDaysIsNotATimeSince1970) {
  constexpr double kFiveDays_us = 5 * 86400e6;
  EXPECT_EQ(unit_of(counts(kFiveDays_us, 1000)), "us");
  EXPECT_NE(counted_time(counts(kFiveDays_us, 1000), {}).why, "");
  EXPECT_EQ(unit_of(counts(1777636800e3, 4)), "ms");
  EXPECT_EQ(unit_of(counts(1777636800e6, 1000)), "us");
  EXPECT_EQ(unit_of(counts(5 * 86400e9, 1e6)), "ns");
}

TEST(CountedTime, TheMotionDeterminesTheUnitIfTheStepsDoNot) {
  const auto time = counts(0, 100);  // 10 Hz of ms, 10 kHz of us
  EXPECT_EQ(unit_of(time, joint_of(time, 1e-6)), "us");
  EXPECT_EQ(unit_of(time, joint_of(time, 1e-3)), "ms");
  EXPECT_EQ(unit_of(counts(0, 4), joint_of(counts(0, 4), 1.0)), "");
}

TEST(CountedTime, StepsOfWholeThousandsCountMicroseconds) {
  for (const double step : {1000.0, 2000.0, 4000.0, 8000.0, 10000.0})
    EXPECT_EQ(unit_of(counts(0, step)), "us") << step;
  EXPECT_EQ(unit_of(counts(0, 20)), "ms");
}

TEST(CountedTime, SecondsStaySeconds) {
  EXPECT_EQ(unit_of(counts(0, 1)), "");
  EXPECT_EQ(unit_of(counts(0, 5)), "");
  EXPECT_EQ(unit_of(counts(0.5, 0.001)), "");
}

TEST(CountedTime, OfATextIsReportedWithTheAssumedUnit) {
  std::string text = "timestamp,q1\n";
  for (int k = 0; k < 50; ++k) text += std::to_string(432'000'000'000 + 1000 * k) + ",0.5\n";
  const ReadLog read = read_csv(text);
  EXPECT_NEAR(read.log.time[1] - read.log.time[0], 1e-3, 1e-9);
  ASSERT_TRUE(read.issues.find("time_unit_assumed", "t"));
  EXPECT_NE(read.issues.find("time_unit_assumed", "t")->message.find("treated as us"), std::string::npos);
}

TEST(CountedTime, NamesOfMicrosecondsAreUnits) {
  for (const char* name : {"time_us", "t_us", "timestamp_micros", "time [us]"}) {
    const ReadLog read = read_csv(std::string(name) + ",q1\n1000,0\n2000,1\n3000,2\n");
    EXPECT_NEAR(read.log.time[0], 1e-3, 1e-12) << name;
  }
}

}  // namespace
}  // namespace faultline
