// SPDX-License-Identifier: MIT
#include "lib/core/parallel.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <thread>
#include <vector>

#include "tests/support/limits.hpp"

namespace faultline {
namespace {

TEST(Parallel, AllWorkIsDoneWhenNoThreadCanBeStarted) {
  const NoThreads limit;
  EXPECT_THROW(std::thread([] {}).join(), std::system_error);
  std::vector<int> done(100);
  parallel_for(100, 8, [&](int i) { done[static_cast<std::size_t>(i)] = 1; });
  EXPECT_EQ(std::accumulate(done.begin(), done.end(), 0), 100);
}

}  // namespace
}  // namespace faultline
