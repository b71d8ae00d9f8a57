// SPDX-License-Identifier: MIT
#include "lib/log/rows/clean.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

Log log_at(std::vector<double> time) {
  Log log;
  log.q.resize(1);
  for (std::size_t i = 0; i < time.size(); ++i) log.q[0].push_back(static_cast<double>(i));
  log.time = std::move(time);
  return log;
}

struct Cleaned {
  Log log;
  Issues issues;
};

Cleaned cleaned(std::vector<double> time) {
  Cleaned result{log_at(std::move(time)), {}};
  CleanState state;
  clean(result.log, 0, true, state, result.issues);
  return result;
}

using Values = std::vector<double>;

TEST(Clean, RepeatedTimeIsLeftOut) {
  const auto [log, issues] = cleaned({0, 1, 1, 1, 2});
  EXPECT_EQ(log.q[0], (Values{0, 1, 4}));
  ASSERT_NE(issues.find("time_repeated", "t"), nullptr);
  EXPECT_EQ(issues.find("time_repeated", "t")->count, 2);
  EXPECT_EQ(issues.find("time_repeated", "t")->first_row, 3);
  EXPECT_EQ(issues.rows_dropped(), 2);
}

TEST(Clean, BackwardTimeIsLeftOutUntilItPassesAgain) {
  const auto [log, issues] = cleaned({0, 1, 2, 0.5, 1.5, 2.5, 3});
  EXPECT_EQ(log.q[0], (Values{0, 1, 2, 5, 6}));
  ASSERT_NE(issues.find("time_backward", "t"), nullptr);
  EXPECT_EQ(issues.find("time_backward", "t")->count, 2);
}

TEST(Clean, MissingAndImpossibleTimesAreLeftOut) {
  const auto [log, issues] = cleaned({0, std::nan(""), 1, 1e282, -INFINITY, 2});
  EXPECT_EQ(log.q[0], (Values{0, 2, 5}));
  ASSERT_NE(issues.find("time_missing", "t"), nullptr);
  ASSERT_NE(issues.find("time_implausible", "t"), nullptr);
  EXPECT_EQ(issues.find("time_implausible", "t")->count, 2);
}

TEST(Clean, ATimeThatLeapsAheadOfTheNextOneIsLeftOut) {
  const auto [log, issues] = cleaned({0, 1, 2, 900, 3, 4});
  EXPECT_EQ(log.q[0], (Values{0, 1, 2, 4, 5}));
  ASSERT_NE(issues.find("time_leap", "t"), nullptr);
  EXPECT_EQ(issues.find("time_leap", "t")->first_row, 4);
  EXPECT_EQ(issues.find("time_backward", "t"), nullptr);
}

TEST(Clean, ALeapThatStaysIsAGapAndKept) {
  const auto [log, issues] = cleaned({0, 1, 2, 900, 901});
  EXPECT_EQ(log.rows(), 5);
  EXPECT_TRUE(issues.empty());
}

TEST(Clean, ALastRowThatLeapsWaitsForTheNextSegment) {
  Log log = log_at({0, 1, 2, 900});
  CleanState state;
  Issues issues;
  const Log waiting = clean(log, 0, false, state, issues);
  EXPECT_EQ(log.rows(), 3);
  ASSERT_EQ(waiting.rows(), 1);
  EXPECT_EQ(waiting.time[0], 900);
}

TEST(Clean, ImpossibleValuesBecomeMissing) {
  Log log = log_at({0, 1, 2});
  log.q[0] = {1.0, 1e282, -INFINITY};
  CleanState state;
  Issues issues;
  clean(log, 0, true, state, issues);
  EXPECT_TRUE(std::isnan(log.q[0][1]) && std::isnan(log.q[0][2]));
  ASSERT_NE(issues.find("value_implausible", "q1"), nullptr);
  EXPECT_EQ(issues.find("value_implausible", "q1")->count, 2);
  EXPECT_EQ(issues.rows_dropped(), 0);
}

}  // namespace
}  // namespace faultline
