// SPDX-License-Identifier: MIT
// Positions that repeat one code, of a robot in closed form.
#include "lib/explain/search/sensor_jumps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::fit_of;
using testing::of_day;
using testing::run_of;
using testing::simulate_closed_form;

/// Lets joint 2 come to rest four times: before each rest its steps shrink to nothing.
Log with_rests(Log log) {
  std::vector<double>& q = log.q[1];
  for (const int first : {200, 600, 1000, 1600})
    for (int k = first; k < first + 150; ++k) {
      const int steps = std::min(k - first, 20);
      q[k] = q[first - 1] + 1e-4 * (steps - steps * steps / 40.0);
    }
  return log;
}

TEST(RepeatedCodes, OfAStuckEncoderAreFoundAmongManyLongerRests) {
  Log log = with_rests(simulate_closed_form(of_day(0), run_of(31)));
  for (int k = 1301; k < 1360; ++k) log.q[1][k] = log.q[1][1300];  // in motion
  const std::vector<FaultSpan> codes = repeated_codes(fit_of(std::move(log)), 1);
  const auto stuck = std::ranges::find_if(
      codes, [](const FaultSpan& code) { return std::abs(code.onset_s - 1300 * 0.004) < 1e-9; });
  ASSERT_NE(stuck, codes.end());
  EXPECT_NEAR(stuck->end_s, 1360 * 0.004, 1e-9);
}

TEST(RepeatedCodes, AreNotFoundAtAMovingJoint) {
  EXPECT_TRUE(repeated_codes(fit_of(simulate_closed_form(of_day(0), run_of(32))), 1).empty());
}

}  // namespace
}  // namespace faultline
