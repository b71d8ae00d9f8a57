// SPDX-License-Identifier: MIT
#include "lib/explain/judge/judge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(JudgedLoad, CannotLoseMoreThanTheLinkCarries) {
  const Log healthy = simulate_closed_form(of_day(0), run_of(15));
  const FaultClaim claim{FaultKind::payload_change, 2_joint, 4.0};
  const LogFit before = fit_of(healthy);
  const LinearFault& load = *linear_of(before.linear(), claim);
  const auto price = [&](double share) {
    const Eigen::MatrixXd unit = unstacked(load.columns.column, 3);
    const LogFit fit = fit_of(changed(healthy, 4.0, kNeverEnds, [&](Log& l, int k) {
      const int row = std::clamp(before.first_row(l.time[k]), 0, before.count() - 1);
      for (int j = 0; j < 3; ++j) l.tau[j][k] -= share * load.carried_kg * unit(row, j);
    }));
    const FaultHypothesis h = judge(fit, claim).value();
    EXPECT_NEAR(h.size[0] / load.carried_kg, -share, 0.1);
    return h.fit.log_likelihood - fit.healthy().log_likelihood - h.gain;
  };
  EXPECT_NEAR(price(0.8), 0.0, 1e-6);
  EXPECT_NEAR(price(1.5), 0.5 * kBeyondLoss, 0.1 * kBeyondLoss);
}

/// Returns the push of joint 2 from 4 to 4.6 s, of the first two forms or of any, that explains a force of
/// this form best; `form`: of the share of the push that has passed, in N m.
template <typename Form>
FaultHypothesis push_of(Form form, bool has_any_form = true) {
  constexpr double kOnset_s = 4.0, kEnd_s = 4.6;
  const LogFit fit =
      fit_of(changed(simulate_closed_form(of_day(0), run_of(15)), kOnset_s, kEnd_s, [&](Log& l, int k) {
        l.tau[1][k] -= form((l.time[k] - kOnset_s) / (kEnd_s - kOnset_s));
      }));
  FaultClaim claim{FaultKind::collision, 2_joint, kOnset_s, kEnd_s};
  claim.has_any_form = has_any_form;
  return judge(fit, claim).value();
}

TEST(JudgedPush, HasTheFormOfAPushThatRisesSteeply) {
  const FaultHypothesis push = push_of([](double s) {
    return 6.0 * std::sin(std::numbers::pi * s) + 3.0 * std::sin(2.0 * std::numbers::pi * s);
  });
  EXPECT_EQ(push.label(), (FaultLabel{FaultKind::collision, 2_joint}));
  ASSERT_EQ(push.size.size(), 12);
  EXPECT_NEAR(push.size[2 * 3 + 1], 3.0, 0.3);
  EXPECT_LT(push.fit.mean_square(), 2.0);
}

TEST(JudgedPush, ExplainsLittleOfAForceThatSwings) {
  const auto swing = [](double s) { return 6.0 * std::sin(2.0 * std::numbers::pi * s); };
  const FaultHypothesis push = push_of(swing),
                        one_sided = push_of([&](double s) { return std::abs(swing(s)); });
  EXPECT_TRUE(push.size.tail(6).isZero(0.0)) << push.size.transpose();
  EXPECT_GT(push.fit.mean_square(), 10.0);
  EXPECT_LT(push.gain, 0.2 * one_sided.gain);
}

TEST(JudgedPush, OfPlainFormHasNoOther) {
  const FaultHypothesis push = push_of([](double s) { return 6.0 * std::sin(std::numbers::pi * s); }, false);
  ASSERT_EQ(push.size.size(), 12);
  EXPECT_TRUE(push.size.tail(6).isZero(0.0)) << push.size.transpose();
}

}  // namespace
}  // namespace faultline
