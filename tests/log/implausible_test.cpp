// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lib/log/rows/row_order.hpp"

namespace faultline {
namespace {

TEST(Implausible, ImpossibleValuesBecomeMissing) {
  Log log;
  log.time = {0, 1, 2};
  log.q = {{1.0, 1e282, -INFINITY}};
  Issues issues;
  blank_implausible(log, 0, issues);
  EXPECT_TRUE(std::isnan(log.q[0][1]) && std::isnan(log.q[0][2]));
  ASSERT_NE(issues.find("value_implausible", "q1"), nullptr);
  EXPECT_EQ(issues.find("value_implausible", "q1")->count, 2);
  EXPECT_EQ(issues.rows_dropped(), 0);
}

}  // namespace
}  // namespace faultline
