// SPDX-License-Identifier: MIT
// Rows that a robot takes in step, with stamps that wobble and rows that were not logged.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/random.hpp"
#include "lib/reproduce/filter/follower.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

constexpr double kPeriod_s = 0.01;
constexpr double kMoves = 0.3;  // rad/s: a joint that rests does not tell when a row was taken

struct Wobbly {
  Log log;
  std::vector<int> taken;  ///< by row: periods since the start
};

/// Stamps are off by a fifth of a period, the first one by more; one row in a hundred is lost.
Wobbly wobbly(const Log& steady, double first_off_s) {
  Random random(7);
  Wobbly out;
  Log rows;
  for (int k = 0; k < steady.rows(); ++k) {
    if (k > 0 && random.uniform() < 0.01) continue;
    append(rows, slice(steady, k, k + 1));
    out.taken.push_back(k);
  }
  for (double& stamp : rows.time) stamp += 0.2 * kPeriod_s * random.normal();
  rows.time.front() = first_off_s;
  for (std::size_t k = 1; k < rows.time.size(); ++k)
    rows.time[k] = std::max(rows.time[k], rows.time[k - 1] + 1e-4);
  out.log = std::move(rows);
  return out;
}

/// Rows of a moving robot whose step was not what it was.
int wrong_steps(const Wobbly& wobbly) {
  MotionModel model = rrp_motion_model();
  model.steady_period_s = kPeriod_s;
  Follower follower(model);
  FollowedSample sample;
  int wrong = 0;
  for (int k = 0; k < wobbly.log.rows(); ++k) {
    follower.follow(wobbly.log, k, sample);
    if (k == 0) continue;
    const double step = kPeriod_s * (wobbly.taken[k] - wobbly.taken[k - 1]);
    const bool moves = std::abs(wobbly.log.dq[0][k]) > kMoves || std::abs(wobbly.log.dq[1][k]) > kMoves;
    wrong += moves && std::abs(sample.dt - step) > 0.2 * kPeriod_s;
  }
  return wrong;
}

TEST(FollowerClock, MotionTellsHowManyPeriodsPassedWhereStampsDoNot) {
  const Log log = simulate(known_rrp(), rrp_run(20.0), 61).log;
  EXPECT_EQ(wrong_steps(wobbly(log, 0.0)), 0);
}

TEST(FollowerClock, AFirstStampThatIsOffDoesNotSetTheClock) {
  const Log log = simulate(known_rrp(), rrp_run(5.0), 62).log;
  EXPECT_EQ(wrong_steps(wobbly(log, 0.6 * kPeriod_s)), 0) << "late";
  EXPECT_EQ(wrong_steps(wobbly(log, -0.6 * kPeriod_s)), 0) << "early";
}

TEST(FollowerClock, AStampMoreThanAPeriodLateIsNoRowThatWasLost) {
  Wobbly log = wobbly(simulate(known_rrp(), rrp_run(5.0), 64).log, 0.0);
  for (int k = 40; k + 1 < log.log.rows(); k += 37)
    log.log.time[k] = log.log.time[k - 1] + 2.2 * kPeriod_s, log.log.time[k + 1] = log.log.time[k] + 1e-4;
  EXPECT_EQ(wrong_steps(log), 0);
}

TEST(FollowerClock, AfterAJointIsLockedTheOthersStillTellTheTime) {
  const Log log = simulate(known_rrp(), rrp_run_with(FaultKind::locked, 1, 2.5), 63).log;
  EXPECT_LE(wrong_steps(wobbly(log, 0.0)), 2);
}

}  // namespace
}  // namespace faultline
