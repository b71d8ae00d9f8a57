// SPDX-License-Identifier: MIT
#include "lib/log/transformed/selected_rows_source.hpp"

#include <gtest/gtest.h>

#include "lib/log/log_source.hpp"

namespace faultline {
namespace {

/// The position is the number of the row.
Log counting(int rows) {
  Log log;
  log.q.resize(1);
  for (int k = 0; k < rows; ++k) {
    log.time.push_back(0.01 * k);
    log.q[0].push_back(k);
  }
  return log;
}

std::vector<double> told(LogSource& source) {
  std::vector<double> rows;
  for (Log segment; source.next(segment);) {
    EXPECT_EQ(segment.q[0].front(), static_cast<double>(segment.first_row));
    rows.insert(rows.end(), segment.q[0].begin(), segment.q[0].end());
  }
  return rows;
}

TEST(SelectedRowsSource, ReturnsTheRowsOfItsRangesForAnySegments) {
  const std::vector<double> expected = {3, 4, 5, 9, 10, 11, 12, 29};
  for (const int segment_rows : {1, 2, 5, 7, 30}) {
    MemorySource source(counting(30), "counting", segment_rows);
    SelectedRowsSource selected(source, {{{3, 6}, {9, 13}, {29, 1'000'000}}});
    EXPECT_EQ(told(selected), expected) << segment_rows;
    selected.rewind();
    EXPECT_EQ(told(selected), expected) << segment_rows << ", again";
  }
}

TEST(SelectedRowsSource, AdjacentRangesGiveRowsWithoutAGap) {
  MemorySource source(counting(10), "counting", 4);
  SelectedRowsSource selected(source, {{{0, 3}, {3, 10}}});
  EXPECT_EQ(told(selected).size(), 10u);
}

TEST(SelectedRowsSource, ReturnsNoRowsWithoutRanges) {
  MemorySource source(counting(10), "counting", 4);
  SelectedRowsSource none(source, {{}}), beyond(source, {{{10, 20}}});
  EXPECT_TRUE(told(none).empty());
  source.rewind();
  EXPECT_TRUE(told(beyond).empty());
}

}  // namespace
}  // namespace faultline
