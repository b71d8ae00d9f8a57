// SPDX-License-Identifier: MIT
#include "lib/balance/end_stop.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::scara_model;

/// The slide falls from `falls_s` on through the end of its range, hits a stop at `hits_s`, bounces for
/// `bounces_s` and stays there.
UniformLog falling(double falls_s, double hits_s, double bounces_s) {
  UniformLog log = testing::on_grid(testing::simulate_closed_form(testing::of_day(0), testing::run_of(31)));
  const auto row_of = [&](double t) { return static_cast<int>(std::lround(t / log.period_s)); };
  const double from = log.q(row_of(falls_s), 2), fall = hits_s - falls_s,
               stop = from - 0.5 * 9.81 * fall * fall;
  for (int k = row_of(falls_s); k < log.rows(); ++k) {
    const double since = log.time_s(k) - falls_s, after = log.time_s(k) - hits_s;
    if (after < 0.0) {
      log.q(k, 2) = from - 0.5 * 9.81 * since * since;
      log.dq(k, 2) = -9.81 * since;
    } else {
      const double share = after < bounces_s ? 1.0 - after / bounces_s : 0.0, w = 60.0;
      log.q(k, 2) = stop + 0.025 * share * std::abs(std::sin(w * after));
      log.dq(k, 2) = 1.5 * share * std::cos(w * after);
    }
  }
  return log;
}

double first_stopped_s(const UniformLog& log) {
  const BalanceModel& m = scara_model();
  const BalanceRows rows = balance_rows(log, m.setting, m.rigid, m.theta);
  const Eigen::MatrixXd std = stop_std(rows, m);
  for (int k = 0; k < rows.rows(); ++k)
    if (std(k, 2) > 0.0) return rows.time_s[k];
  return -1.0;
}

TEST(EndStop, RowsCountForNothingFromTheFirstHaltOn) {
  for (const double bounces_s : {0.02, 0.28})
    EXPECT_NEAR(first_stopped_s(falling(4.0, 4.3, bounces_s)), 4.3, 0.06) << bounces_s;
}

TEST(EndStop, AJointThatMovesOnIsHeldByNone) {
  EXPECT_EQ(first_stopped_s(
                testing::on_grid(testing::simulate_closed_form(testing::of_day(0), testing::run_of(31)))),
            -1.0);
}

}  // namespace
}  // namespace faultline
