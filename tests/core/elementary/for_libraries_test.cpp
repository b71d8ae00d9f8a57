// SPDX-License-Identifier: MIT
// What libraries ask the C library and the processor for, as they are linked into this program.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/random.hpp"

namespace faultline {
namespace {

/// Ceres' trust region calls pow(); of a thousand powers the C library's differ in some.
TEST(LinkedLibraries, CallTheElementaryFunctionsOfTheProject) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    volatile double x = 20.0 * random.uniform(), y = 3.0 * random.uniform();
    ASSERT_EQ(std::pow(x, y), elementary::pow(x, y));
    ASSERT_EQ(std::exp(x), elementary::exp(x));
    ASSERT_EQ(std::log(x), elementary::log(x));
    ASSERT_EQ(std::sin(x), elementary::sin(x));
    ASSERT_EQ(std::cos(x), elementary::cos(x));
    ASSERT_EQ(std::atan2(x, y), elementary::atan2(x, y));
  }
}

/// Eigen cuts the sums of long products to the caches it finds.
TEST(LinkedLibraries, EigenAssumesTheSameCachesOnEveryMachine) {
  EXPECT_EQ(Eigen::l1CacheSize(), 32 * 1024);
  EXPECT_EQ(Eigen::l2CacheSize(), 256 * 1024);
  EXPECT_EQ(Eigen::l3CacheSize(), 2 * 1024 * 1024);
}

}  // namespace
}  // namespace faultline
