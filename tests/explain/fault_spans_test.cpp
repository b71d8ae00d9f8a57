// SPDX-License-Identifier: MIT
// The spans of a fault that comes and goes, of a robot in closed form.
#include "lib/explain/fault_spans.hpp"

#include <gtest/gtest.h>

#include "lib/explain/search/white_search.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::ClosedFormRun;
using testing::fit_of;
using testing::of_day;
using testing::run_of;
using testing::simulate_closed_form;
using testing::with_loss;
using testing::with_loss_but_for_a_second;

TEST(FaultSpans, AreThoseInWhichTheLogShowsTheFault) {
  const LogFit fit = fit_of(with_loss_but_for_a_second(26));
  for (const FaultClaim& claim :
       {FaultClaim{FaultKind::torque_loss, 1_joint, 3.5}, FaultClaim{FaultKind::torque_loss, 1_joint, 6.6}}) {
    const std::vector<FaultClaim> spans = fault_spans(fit, claim, free_form(fit));
    ASSERT_EQ(spans.size(), 2u);
    EXPECT_NEAR(spans[0].onset_s, 3.5, 0.05);
    EXPECT_NEAR(spans[0].end_s, 5.5, 0.05);
    EXPECT_NEAR(spans[1].onset_s, 6.5, 0.05);
    EXPECT_EQ(spans[1].end_s, kNeverEnds);
    EXPECT_NEAR(spans[0].size[0], 0.5, 0.02);
  }
}

TEST(FaultSpans, AStrongFaultDoesNotDistortTheEffectsOfTheDay) {
  ClosedFormRun run = run_of(27);
  run.duration_s = 10.0;
  Log log = with_loss(simulate_closed_form(of_day(0), run), 2_joint, 0.98, 2.2, 4.2);
  const LogFit fit = fit_of(with_loss(std::move(log), 2_joint, 0.98, 6.2));
  const std::vector<FaultClaim> spans =
      fault_spans(fit, {FaultKind::torque_loss, 2_joint, 0.6}, free_form(fit));
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_NEAR(spans[0].onset_s, 2.2, 0.05);
  EXPECT_NEAR(spans[0].end_s, 4.2, 0.05);
  EXPECT_NEAR(spans[1].onset_s, 6.2, 0.05);
}

TEST(FaultSpans, AFaultFromTheFirstRowOnBeginsAfterTheLeadTime) {
  const LogFit fit = fit_of(with_loss(simulate_closed_form(of_day(0), run_of(26)), 1_joint, 0.5, 0.0, 4.0));
  const std::vector<FaultClaim> spans =
      fault_spans(fit, {FaultKind::torque_loss, 1_joint, 0.6}, free_form(fit));
  ASSERT_EQ(spans.size(), 1u);
  EXPECT_NEAR(spans[0].onset_s, kLead_s, 0.1);
}

TEST(FaultSpans, AFaultThatTheLogDoesNotShowHasNoSpan) {
  const LogFit fit = fit_of(simulate_closed_form(of_day(0), run_of(26)));
  EXPECT_TRUE(fault_spans(fit, {FaultKind::torque_loss, 1_joint, 3.5}, free_form(fit)).empty());
}

TEST(FaultSpans, ANonlinearFaultHasNoSpan) {
  const LogFit fit = fit_of(with_loss_but_for_a_second(26));
  EXPECT_TRUE(fault_spans(fit, {FaultKind::locked, 1_joint, 3.5}, free_form(fit)).empty());
}

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

TEST(AbsentFrom, AFaultThatEveryRowShowsLasts) {
  EXPECT_FALSE(absent_from_s(fit(), gone_for(5.0, 0.0), kOnset_s));
}

TEST(AbsentFrom, AFaultThatPausesForAWhileEndsThere) {
  const auto end_s = absent_from_s(fit(), gone_for(5.0, 0.6), kOnset_s);
  ASSERT_TRUE(end_s);
  EXPECT_NEAR(*end_s, 5.0, 0.05);
}

TEST(AbsentFrom, AShortPauseIsNotTheEndOfAFault) {
  EXPECT_FALSE(absent_from_s(fit(), gone_for(5.0, 0.15), kOnset_s));
}

}  // namespace
}  // namespace faultline
