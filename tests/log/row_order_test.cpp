// SPDX-License-Identifier: MIT
#include "lib/log/rows/row_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faultline {
namespace {

using Values = std::vector<double>;

/// Rows with their numbers as position, from 0.
Log log_at(const Values& time) {
  Log log;
  log.time = time;
  log.q.assign(1, Values(time.size()));
  std::iota(log.q[0].begin(), log.q[0].end(), 0.0);
  return log;
}

struct Ordered {
  Log log;
  Issues issues;
  std::vector<LogRun> runs;
};

Ordered ordered(const Values& time, int run = kEveryRun, int rows_at_a_time = 1000000) {
  Ordered out;
  RowOrder order(run);
  const Log all = log_at(time);
  const auto give = [&] {
    for (Log part; order.give(part, rows_at_a_time);) append(out.log, part);
  };
  for (int i = 0; i < all.rows(); i += rows_at_a_time) {
    order.take(slice(all, i, std::min(i + rows_at_a_time, all.rows())), i, out.issues);
    give();
  }
  order.finish(out.issues);
  give();
  out.runs = order.runs();
  EXPECT_EQ(out.log.rows() + out.issues.rows_dropped(), all.rows()) << "rows read = rows kept + rows listed";
  EXPECT_TRUE(std::is_sorted(out.log.time.begin(), out.log.time.end(), std::less_equal<>()) ||
              out.log.rows() < 2);
  return out;
}

/// From `first` on, `rows` of them, each `step` later.
Values clock_from(double first, int rows, double step = 1.0) {
  Values time(rows);
  for (int i = 0; i < rows; ++i) time[i] = first + i * step;
  return time;
}

Values operator+(Values a, const Values& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(RowOrder, RepeatedTimeIsLeftOut) {
  const auto [log, issues, runs] = ordered({0, 1, 1, 1, 2});
  EXPECT_EQ(log.q[0], (Values{0, 1, 4}));
  ASSERT_NE(issues.find("time_repeated", "t"), nullptr);
  EXPECT_EQ(issues.find("time_repeated", "t")->count, 2);
  EXPECT_EQ(issues.find("time_repeated", "t")->first_row, 3);
}

TEST(RowOrder, ARowBeforeEarlierOnesIsLeftOutWhereNoRowIsMissing) {
  const auto [log, issues, runs] = ordered(clock_from(0, 20) + Values{17.5, 18.5} + clock_from(20, 5));
  EXPECT_EQ(log.rows(), 25);
  ASSERT_NE(issues.find("time_backward", "t"), nullptr);
  EXPECT_EQ(issues.find("time_backward", "t")->count, 2);
}

TEST(RowOrder, ALateRowIsMovedToThePlaceWhereItIsMissing) {
  const auto [log, issues, runs] = ordered({0, 1, 2, 3, 5, 6, 7, 8, 9, 10, 4, 11, 12});
  EXPECT_EQ(log.time, clock_from(0, 13));
  EXPECT_EQ(log.q[0], (Values{0, 1, 2, 3, 10, 4, 5, 6, 7, 8, 9, 11, 12}));
  ASSERT_NE(issues.find("time_out_of_order", "t"), nullptr);
  EXPECT_EQ(issues.find("time_out_of_order", "t")->count, 1);
  EXPECT_EQ(issues.find("time_out_of_order", "t")->first_row, 11);
  EXPECT_EQ(issues.rows_dropped(), 0);
}

TEST(RowOrder, RowsOfTwoThreadsAreSortedAndNoneIsLost) {
  Values time = clock_from(0, 3000, 0.01);
  for (int i = 0; i + 100 < 3000; i += 150)
    std::rotate(time.begin() + i, time.begin() + i + 90, time.begin() + i + 92);
  time[0] = 0.203;  // the first row is early, and off the others' grid
  const auto [log, issues, runs] = ordered(time);
  EXPECT_EQ(log.rows(), 3000);
  EXPECT_EQ(runs.size(), 1u);
}

TEST(RowOrder, ARowThatComesLaterThanTheWindowIsLeftOut) {
  Values time = clock_from(0, 3000);
  std::rotate(time.begin() + 100, time.begin() + 101, time.begin() + 102 + kOrderWindowRows);
  const auto [log, issues, runs] = ordered(time);
  EXPECT_EQ(log.rows(), 2999);
  EXPECT_NE(issues.find("time_backward", "t"), nullptr);
}

TEST(RowOrder, MissingAndImpossibleTimesAreLeftOut) {
  const auto [log, issues, runs] = ordered({0, std::nan(""), 1, 1e282, -INFINITY, 2});
  EXPECT_EQ(log.q[0], (Values{0, 2, 5}));
  ASSERT_NE(issues.find("time_missing", "t"), nullptr);
  ASSERT_NE(issues.find("time_implausible", "t"), nullptr);
  EXPECT_EQ(issues.find("time_implausible", "t")->count, 2);
}

TEST(RowOrder, ATimeFarAheadOfTheFollowingTimesIsLeftOut) {
  const auto [log, issues, runs] = ordered({0, 1, 2, 900, 3, 4});
  EXPECT_EQ(log.q[0], (Values{0, 1, 2, 4, 5}));
  ASSERT_NE(issues.find("time_leap", "t"), nullptr);
  EXPECT_EQ(issues.find("time_leap", "t")->first_row, 4);
  EXPECT_EQ(issues.find("time_backward", "t"), nullptr);
}

TEST(RowOrder, AJumpOfTheClockThatLastsIsAGap) {
  const auto [log, issues, runs] = ordered({0, 1, 2, 900, 901});
  EXPECT_EQ(log.rows(), 5);
  EXPECT_TRUE(issues.empty());
}

TEST(RowOrder, AClockThatRestartsBeginsARunThatFollowsTheOneBefore) {
  const auto [log, issues, runs] = ordered(clock_from(0, 50) + clock_from(0.5, 60) + clock_from(0, 3));
  EXPECT_EQ(log.rows(), 113);
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[1].first_row, 51);
  EXPECT_EQ(runs[1].rows, 60);
  EXPECT_EQ(runs[1].start_s - runs[1].clock_offset_s, 0.5);
  EXPECT_EQ(runs[1].end_s - runs[1].clock_offset_s, 59.5);
  EXPECT_GE(runs[1].start_s - runs[0].end_s, 8.0) << "every stage takes that for a gap";
  ASSERT_NE(issues.find("clock_restart", "t"), nullptr);
  EXPECT_EQ(issues.find("clock_restart", "t")->count, 2);
}

TEST(RowOrder, AClockThatIsSetBackALittleBeginsANewRun) {
  const auto [log, issues, runs] = ordered(clock_from(1000, 4000) + clock_from(4900.25, 300));
  EXPECT_EQ(log.rows(), 4300);
  EXPECT_EQ(runs.size(), 2u);
}

TEST(RowOrder, OneRunIsReadOnItsOwnClock) {
  const Values time = clock_from(0.1, 50) + clock_from(0.7, 60);
  const auto [log, issues, runs] = ordered(time, 2);
  EXPECT_EQ(log.time, clock_from(0.7, 60));
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_FALSE(runs[0].is_read);
  EXPECT_TRUE(runs[1].is_read);
  EXPECT_EQ(runs[1].start_s, 0.7);
  EXPECT_EQ(runs[1].clock_offset_s, 0.0);
  EXPECT_EQ(issues.find("other_run", "t")->count, 50);
}

TEST(RowOrder, RowsThatAreSentTwiceAreNotARun) {
  const Log once = log_at(clock_from(0, 100));
  RowOrder order;
  Issues issues;
  order.take(once, 0, issues);
  order.take(slice(once, 20, 90), 100, issues);
  order.finish(issues);
  Log log;
  ASSERT_TRUE(order.give(log, 1000));
  EXPECT_EQ(log.rows(), 100);
  EXPECT_EQ(order.runs().size(), 1u);
  EXPECT_EQ(issues.find("time_repeated", "t")->count, 70);
}

TEST(RowOrder, ATimeOfDayContinuesAfterMidnight) {
  const auto [log, issues, runs] = ordered(clock_from(86350, 50) + clock_from(0, 40));
  EXPECT_EQ(log.time, clock_from(86350, 90));
  EXPECT_EQ(runs.size(), 1u);
  ASSERT_NE(issues.find("clock_midnight", "t"), nullptr);
  EXPECT_EQ(issues.find("clock_midnight", "t")->severity, Severity::note);
  EXPECT_EQ(issues.find("clock_restart", "t"), nullptr);
}

TEST(RowOrder, ARowFromBeforeMidnightMayArriveAfterIt) {
  Values time = clock_from(86350, 50) + clock_from(0, 40);
  std::rotate(time.begin() + 45, time.begin() + 46, time.begin() + 60);
  const auto [log, issues, runs] = ordered(time);
  EXPECT_EQ(log.time, clock_from(86350, 90));
}

TEST(RowOrder, ANewRunBeforeMidnightFollowsARunThatPassedMidnight) {
  const Values night = clock_from(86350, 50) + clock_from(0, 40);
  for (const double evening : {86350.0, 86345.0, 86380.0, 80000.0}) {
    const Values again = evening < 86000.0
                             ? clock_from(evening, 90)
                             : clock_from(evening, static_cast<int>(86400.0 - evening)) + clock_from(0, 40);
    const auto [log, issues, runs] = ordered(night + again + again);
    ASSERT_EQ(runs.size(), 3u) << evening;
    EXPECT_EQ(log.rows(), static_cast<int>(night.size() + 2 * again.size())) << evening;
    EXPECT_EQ(runs[2].first_row, static_cast<std::int64_t>(night.size() + again.size()) + 1);
    const Values own = ordered(night + again + again, 2).log.time;
    ASSERT_EQ(own.size(), again.size());
    EXPECT_EQ(own.front(), evening);
  }
}

TEST(RowOrder, RowsThatWereLostBeforeAShortLastRunAreSevere) {
  const auto lost = ordered(clock_from(0, 100) + Values(30, std::nan("")) + clock_from(50, 2));
  EXPECT_NE(lost.issues.find("rows_not_judged", "t"), nullptr);
}

TEST(RowOrder, ManyRowsWithoutAUsableTimeInSuccessionAreSevere) {
  const Values none(30, std::nan(""));
  const auto lost = ordered(clock_from(0, 100) + none + clock_from(130, 100));
  ASSERT_NE(lost.issues.find("rows_not_judged", "t"), nullptr);
  EXPECT_EQ(lost.issues.find("rows_not_judged", "t")->severity, Severity::severe);
  EXPECT_EQ(lost.issues.find("rows_not_judged", "t")->first_row, 101);
  const auto few = ordered(clock_from(0, 100) + Values(5, std::nan("")) + clock_from(105, 100));
  EXPECT_EQ(few.issues.find("rows_not_judged", "t"), nullptr);
}

TEST(RowOrder, TheSizeOfTheSegmentsChangesNothing) {
  Values time = clock_from(0.25, 2500, 0.01);
  for (int i = 0; i + 100 < 2500; i += 137)
    std::rotate(time.begin() + i, time.begin() + i + 60, time.begin() + i + 63);
  time[700] = 900.0;
  time[900] = std::nan("");
  time = time + clock_from(86399, 150, 0.01) + clock_from(0, 1200, 0.01) + clock_from(0, 10, 0.01);
  for (const int run : {kEveryRun, 2}) {
    const auto whole = ordered(time, run);
    for (const int rows : {1, 7, 999, 1000, 1001}) {
      const auto parts = ordered(time, run, rows);
      EXPECT_EQ(parts.log.time, whole.log.time) << rows;
      EXPECT_EQ(parts.log.q, whole.log.q) << rows;
      ASSERT_EQ(parts.issues.all().size(), whole.issues.all().size());
      for (std::size_t i = 0; i < whole.issues.all().size(); ++i) {
        EXPECT_EQ(parts.issues.all()[i].message, whole.issues.all()[i].message);
        EXPECT_EQ(parts.issues.all()[i].count, whole.issues.all()[i].count);
      }
    }
  }
}

}  // namespace
}  // namespace faultline
