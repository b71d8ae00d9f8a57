// SPDX-License-Identifier: MIT
#include "lib/log/prefetch.hpp"

#include <gtest/gtest.h>

#include "lib/log/log_source.hpp"
#include "tests/support/limits.hpp"

namespace faultline {
namespace {

Log long_log() {
  Log log;
  log.q.resize(1);
  for (int i = 0; i < 1000; ++i) {
    log.time.push_back(i);
    log.q[0].push_back(2.0 * i);
  }
  return log;
}

TEST(Prefetch, ReadsInTheCallingThreadIfNoThreadCanBeStarted) {
  const auto source = prefetched(std::make_unique<MemorySource>(long_log(), "a.csv", 100));
  const NoThreads limit;
  for (int time = 0; time < 2; ++time) {
    EXPECT_EQ(read_all(*source).q[0], long_log().q[0]);
    source->rewind();
  }
}

}  // namespace
}  // namespace faultline
