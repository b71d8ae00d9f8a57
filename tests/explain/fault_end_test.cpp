// SPDX-License-Identifier: MIT
// When a log shows that a fault is gone, by whitened rows that the test makes up.
#include "lib/explain/fault_end.hpp"

#include <gtest/gtest.h>

#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::fit_of;
using testing::of_day;
using testing::run_of;
using testing::simulate_closed_form;

constexpr double kOnset_s = 2.0, kFaultOfRow = 20.0, kNotQuite = 10.0;

const LogFit& fit() {
  static const LogFit fit = fit_of(simulate_closed_form(of_day(0), run_of(21)));
  return fit;
}

/// A fault that each row of joint 2 shows, but from `gone_s` on for `length_s`.
WithAndWithout gone_for(double gone_s, double length_s) {
  WithAndWithout out{Stacked::Zero(fit().count() * fit().joints()),
                     Stacked::Zero(fit().count() * fit().joints())};
  for (int k = 0; k < fit().count(); ++k) {
    const double t = fit().time_s()[k];
    const bool is_gone = t >= gone_s && t < gone_s + length_s;
    out.with[fit().count() + k] = is_gone ? kNotQuite : 0.0;
    out.without[fit().count() + k] = is_gone ? 0.0 : kFaultOfRow;
  }
  return out;
}

TEST(GoneFrom, AFaultThatEveryRowShowsLasts) {
  EXPECT_FALSE(absent_from_s(fit(), gone_for(5.0, 0.0), kOnset_s));
}

TEST(GoneFrom, AFaultThatIsGoneForAWhileEndsThere) {
  const auto end_s = absent_from_s(fit(), gone_for(5.0, 0.6), kOnset_s);
  ASSERT_TRUE(end_s);
  EXPECT_NEAR(*end_s, 5.0, 0.05);
}

TEST(GoneFrom, AMomentThatLooksHealthyIsNoEnd) {
  EXPECT_FALSE(absent_from_s(fit(), gone_for(5.0, 0.15), kOnset_s));
}

}  // namespace
}  // namespace faultline
