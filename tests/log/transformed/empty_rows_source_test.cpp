// SPDX-License-Identifier: MIT
#include "lib/log/transformed/empty_rows_source.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "lib/log/log_source.hpp"

namespace faultline {
namespace {

/// Rows of a clock of 13.7 Hz, those that `is_lost` says left out.
Log with_lost_rows(int rows, const std::function<bool(int)>& is_lost, double jitter_s = 0.0) {
  Log log;
  log.q.resize(1);
  for (int k = 0; k < rows; ++k) {
    if (is_lost(k)) continue;
    log.time.push_back(0.073 * k + (k % 2 == 0 ? jitter_s : -jitter_s));
    log.q[0].push_back(k);
  }
  return log;
}

Log filled(const Log& log, int segment_rows = 4096) {
  MemorySource source(log, "log", segment_rows);
  EmptyRowsSource with_empty_rows(source);
  Log all = read_all(with_empty_rows);
  with_empty_rows.rewind();
  EXPECT_EQ(read_all(with_empty_rows).time, all.time) << "again";
  EXPECT_EQ(with_empty_rows.identity().rows_read, log.rows());
  return all;
}

TEST(EmptyRowsSource, ALostRowBecomesAnEmptyRowForAnySegments) {
  const Log log = with_lost_rows(200, [](int k) { return k == 3 || k == 70 || k == 150 || k == 151; });
  for (const int segment_rows : {1, 7, 64, 70, 4096}) {
    const Log all = filled(log, segment_rows);
    ASSERT_EQ(all.rows(), 200);
    for (int k = 0; k < 200; ++k) {
      EXPECT_NEAR(all.time[k], 0.073 * k, 1e-9);
      if (k == 3 || k == 70 || k == 150 || k == 151)
        EXPECT_TRUE(std::isnan(all.q[0][k])) << k;
      else
        EXPECT_EQ(all.q[0][k], k);
    }
  }
}

TEST(EmptyRowsSource, ALongGapStaysAGap) {
  const Log log = with_lost_rows(200, [](int k) { return k >= 100 && k < 100 + kMostEmptyRows + 1; });
  EXPECT_EQ(filled(log).rows(), log.rows());
}

TEST(EmptyRowsSource, TwoPeriodsAreNotALostRowIfSomeTimeStampsAreLate) {
  Log log = with_lost_rows(1000, [](int k) { return k % 100 == 99; });
  for (int k = 10; k < log.rows(); k += 40)
    log.time[k] += 0.5 * 0.073;  // as whole milliseconds make of 500 Hz
  EXPECT_EQ(filled(log).rows(), log.rows());
}

TEST(EmptyRowsSource, NoLostRowIsFilledIfTheClockJitters) {
  const Log log = with_lost_rows(
      200, [](int k) { return k == 100; }, 0.02);
  EXPECT_EQ(filled(log).rows(), log.rows());
}

}  // namespace
}  // namespace faultline
