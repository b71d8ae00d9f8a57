// SPDX-License-Identifier: MIT
#include "lib/log/transformed/watched_source.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "lib/log/prefetch.hpp"

namespace faultline {
namespace {

/// A log of 100 rows in segments of ten that knows how much of it was handed out.
class CountedSource : public MemorySource {
 public:
  CountedSource() : MemorySource(rows(), "run.csv", 10) {}
  bool next(Log& segment) override {
    if (!MemorySource::next(segment)) return false;
    read_ += segment.rows();
    return true;
  }
  void rewind() override {
    MemorySource::rewind();
    read_ = 0;
  }
  double share_read() const override { return read_ / 100.0; }

 private:
  static Log rows() {
    Log log;
    log.q.resize(1);
    for (int i = 0; i < 100; ++i) {
      log.time.push_back(i);
      log.q[0].push_back(2.0 * i);
    }
    return log;
  }
  int read_ = 0;
};

const std::vector<double> kTenths = {.1, .2, .3, .4, .5, .6, .7, .8, .9, 1.0, 1.0};

TEST(WatchedSource, CallsWithTheShareOfEachSegmentAgainAfterARewind) {
  std::vector<double> shares;
  const auto log =
      watched_log(std::make_unique<CountedSource>(), [&](double share) { shares.push_back(share); });
  EXPECT_EQ(read_all(*log).rows(), 100);
  EXPECT_EQ(shares, kTenths);
  log->rewind();
  read_all(*log);
  EXPECT_EQ(shares.size(), 2 * kTenths.size());
}

TEST(WatchedSource, OfALogThatIsReadAheadHasTheSharesHandedOut) {
  std::vector<double> shares;
  const auto log = watched_log(prefetched(std::make_unique<CountedSource>()),
                               [&](double share) { shares.push_back(share); });
  read_all(*log);
  EXPECT_EQ(shares, kTenths);
  log->rewind();
  EXPECT_EQ(log->share_read(), 0.0);
}

TEST(WatchedSource, WhatTheWatcherThrowsEndsTheReading) {
  const auto log = watched_log(std::make_unique<CountedSource>(), [](double share) {
    if (share > 0.25) throw std::runtime_error("enough");
  });
  Log segment;
  EXPECT_TRUE(log->next(segment));
  EXPECT_TRUE(log->next(segment));
  EXPECT_THROW(log->next(segment), std::runtime_error);
}

}  // namespace
}  // namespace faultline
