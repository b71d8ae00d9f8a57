// SPDX-License-Identifier: MIT
#include "lib/explain/judge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/explain/free_form.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::changed;
using testing::fit_of;
using testing::of_day;
using testing::run_of;
using testing::simulate_closed_form;

/// Returns the number of rows of joint 2 after the onset that have weight.
double rows_after(const LogFit& fit, double onset_s) {
  double out = 0.0;
  for (int k = 0; k < fit.count(); ++k) out += fit.time_s()[k] > onset_s && fit.std()(k, 1) < kNoWeight;
  return out;
}

TEST(PriceOfShrinking, IsTheLogarithmOfTheTorqueThatTheDayLeavesForEachRow) {
  constexpr double kDelayAndSpring = 1e-3;  // nats: their torque is no part of inertia and friction
  const LogFit fit = fit_of(simulate_closed_form(of_day(0), run_of(15)));
  const DayLayout at = day_layout(fit.model());
  const FaultClaim loss{FaultKind::torque_loss, 2_joint, 4.0};
  Explanation e;
  e.day = Eigen::VectorXd::Zero(at.count());
  EXPECT_EQ(price_of_shrinking(fit, loss, e), 0.0);
  e.day[at.gain(1)] = -0.3;
  EXPECT_NEAR(price_of_shrinking(fit, loss, e), -rows_after(fit, 4.0) * std::log(0.7), kDelayAndSpring);
  e.day.setZero();
  e.day.head(at.base).setConstant(-0.3);
  const double of_inertia = price_of_shrinking(fit, loss, e);
  EXPECT_GT(of_inertia, 0.0);
  e.day[at.friction(1)] = -0.3;
  EXPECT_GT(price_of_shrinking(fit, loss, e), of_inertia);
  EXPECT_NEAR(price_of_shrinking(fit, loss, e), -rows_after(fit, 4.0) * std::log(0.7), kDelayAndSpring);
}

TEST(PriceOfShrinking, IsThatOfRowsWithATorqueOfTheirOwnAtMost) {
  const LogFit fit = fit_of(simulate_closed_form(of_day(0), run_of(15)));
  const DayLayout at = day_layout(fit.model());
  Explanation e;
  e.day = Eigen::VectorXd::Zero(at.count());
  e.day[at.gain(1)] = -1.5;
  double free = 0.0;
  for (int k = 0; k < fit.count(); ++k)
    if (fit.time_s()[k] > 4.0 && fit.std()(k, 1) < kNoWeight) free += free_row_price(fit, k, 1);
  EXPECT_NEAR(price_of_shrinking(fit, {FaultKind::free_swinging, 2_joint, 4.0}, e), free, 1e-9);
}

TEST(PriceOfShrinking, IsPaidByTorqueLossesAlone) {
  const LogFit fit = fit_of(simulate_closed_form(of_day(0), run_of(15)));
  const DayLayout at = day_layout(fit.model());
  Explanation e;
  e.day = Eigen::VectorXd::Constant(at.count(), -0.3);
  EXPECT_GT(price_of_shrinking(fit, {FaultKind::torque_loss, 2_joint, 4.0}, e), 0.0);
  EXPECT_EQ(price_of_shrinking(fit, {FaultKind::friction_increase, 2_joint, 4.0}, e), 0.0);
}

/// Returns the push of joint 2 from 4 to 4.6 s that explains a force of this form best; `form`: of the share
/// of the push that has passed, in N m.
template <typename Form>
FaultHypothesis push_of(Form form) {
  constexpr double kOnset_s = 4.0, kEnd_s = 4.6;
  const LogFit fit =
      fit_of(changed(simulate_closed_form(of_day(0), run_of(15)), kOnset_s, kEnd_s, [&](Log& l, int k) {
        l.tau[1][k] -= form((l.time[k] - kOnset_s) / (kEnd_s - kOnset_s));
      }));
  return judge(fit, {FaultKind::collision, 2_joint, kOnset_s, kEnd_s}).value();
}

TEST(JudgedPush, HasTheFormOfAPushThatRisesTwice) {
  const FaultHypothesis push = push_of([](double s) { return 6.0 * std::sin(3.0 * std::numbers::pi * s); });
  EXPECT_EQ(push.label(), (FaultLabel{FaultKind::collision, 2_joint}));
  ASSERT_EQ(push.size.size(), 12);
  EXPECT_NEAR(push.size[3 * 3 + 1], 6.0, 0.6);
  EXPECT_LT(push.fit.mean_square(), 2.0);
}

TEST(JudgedPush, OfPlainFormHasNoOther) {
  const FaultHypothesis push = push_of([](double s) { return 6.0 * std::sin(std::numbers::pi * s); });
  ASSERT_EQ(push.size.size(), 12);
  EXPECT_TRUE(push.size.tail(6).isZero(0.0)) << push.size.transpose();
}

}  // namespace
}  // namespace faultline
