// SPDX-License-Identifier: MIT
// A joint that is locked by a brake that yields to the torque, of a robot in closed form.
#include "lib/explain/search/standstill.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "lib/explain/explain.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::fit_of;
using testing::of_day;
using testing::run_of;
using testing::scara_model;
using testing::simulate_closed_form;

constexpr double kLocks_s = 4.0, kCompliance = 1e-4, kLimit = 30.0;  // rad per N m, N m
constexpr double kSettles_s = 0.02;                                  // time constant of the brake

/// Joint 2 locks; its controller then asks for the limit in both directions in turn, and the brake yields.
Log with_yielding_lock() {
  testing::ClosedFormRun run = run_of(31);
  run.locks_from_s = kLocks_s;
  Log log = simulate_closed_form(of_day(0), run);
  double deflection = 0.0;
  for (int k = 0; k < log.rows(); ++k) {
    const double since = log.time[k] - kLocks_s;
    if (since <= 0.0) continue;
    log.tau[1][k] = std::fmod(since, 1.4) < 0.7 ? kLimit : -kLimit;
    const double speed = (kCompliance * log.tau[1][k] - deflection) / kSettles_s;
    deflection += speed * (log.time[k] - log.time[k - 1]);
    log.q[1][k] += deflection;
    log.dq[1][k] += speed;
  }
  return log;
}

TEST(Standstill, TheComplianceOfALockFollowsFromItsTorque) {
  const LogFit fit = fit_of(with_yielding_lock());
  const int first = fit.first_row(kLocks_s + 0.2);
  std::vector<int> rows(fit.count() - first);
  std::iota(rows.begin(), rows.end(), first);
  EXPECT_NEAR(yielding_of_lock(fit, 1, rows).compliance, kCompliance, 0.2 * kCompliance);
  EXPECT_EQ(yielding_of_gear(fit, 1).compliance, 0.0);
}

TEST(Standstill, AJointThatMovesFollowsNoLock) {
  const LogFit fit = fit_of(simulate_closed_form(of_day(0), run_of(32)));
  std::vector<int> rows(fit.count());
  std::iota(rows.begin(), rows.end(), 0);
  EXPECT_EQ(yielding_of_lock(fit, 1, rows).compliance, 0.0);
  const auto moves = moves_from(fit, 1, 3.0);
  ASSERT_TRUE(moves);
  EXPECT_LT(*moves, 4.0);
}

TEST(Standstill, ALockThatYieldsLastsToTheEnd) {
  const LogFit fit = fit_of(with_yielding_lock());
  EXPECT_NEAR(fit.time_s()[still_since(fit, 1)], kLocks_s, 0.15);
  EXPECT_FALSE(moves_from(fit, 1, kLocks_s + 0.05));
}

TEST(Standstill, AJointHeldByAYieldingLockDoesNotSwingFreely) {
  const LogExplanation e = explain_log(fit_of(with_yielding_lock()));
  ASSERT_FALSE(e.best.empty());
  EXPECT_EQ(e.best.front().label(), (FaultLabel{FaultKind::locked, 2_joint}));
  EXPECT_NEAR(e.best.front().onset_s, kLocks_s, 0.1);
}

}  // namespace
}  // namespace faultline
