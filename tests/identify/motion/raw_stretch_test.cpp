// SPDX-License-Identifier: MIT
#include "lib/identify/motion/raw_stretch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/log/log_source.hpp"

namespace faultline {
namespace {

Log moving(double period_s) {
  Log log;
  log.q.resize(1);
  for (int k = 0; k < 200; ++k) {
    log.time.push_back(period_s * k);
    log.q[0].push_back(std::sin(0.1 * k));
  }
  log.dq = log.tau = log.q;
  return log;
}

struct Read {
  std::vector<RawStretch> stretches;
  StretchSummary summary;
};

Read read(const Log& log) {
  MemorySource source(log);
  Read out;
  out.summary = for_each_raw_stretch(source, 1, RepeatedRows::none,
                                     [&](const RawStretch& stretch) { out.stretches.push_back(stretch); });
  return out;
}

TEST(RawStretch, ALostRowAndAnEmptyRowGiveTheSameStretches) {
  for (const double period_s : {0.002, 0.073}) {
    Log lost = slice(moving(period_s), 0, 90), empty = moving(period_s);
    append(lost, slice(moving(period_s), 91, 200));
    for (JointSignals* signals : {&empty.q, &empty.dq, &empty.tau}) (*signals)[0][90] = std::nan("");
    const Read without = read(lost), blank = read(empty);
    ASSERT_EQ(without.stretches.size(), blank.stretches.size());
    for (std::size_t i = 0; i < blank.stretches.size(); ++i) {
      EXPECT_EQ(without.stretches[i].time, blank.stretches[i].time);
      EXPECT_EQ(without.stretches[i].q, blank.stretches[i].q);
      EXPECT_EQ(without.stretches[i].tau, blank.stretches[i].tau);
    }
    EXPECT_EQ(without.summary.rows, blank.summary.rows);
  }
}

}  // namespace
}  // namespace faultline
