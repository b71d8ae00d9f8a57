// SPDX-License-Identifier: MIT
// Torque ripples that a log has and the healthy logs did not have, of a robot in closed form.
#include "lib/explain/day/day_ripples.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/explain/explain_faults.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::changed;
using testing::of_day;
using testing::on_grid;
using testing::run_of;
using testing::scara_model;
using testing::simulate_closed_form;
using testing::with_loss;

/// A torque of this amplitude that repeats with the position of a joint, from a time on.
Log with_ripple(Log log, Joint joint, double rate, double amplitude, double from_s = 0.0) {
  return changed(std::move(log), from_s, kNeverEnds, [=](Log& l, int k) {
    l.tau[joint.index()][k] += amplitude * std::sin(rate * l.q[joint.index()][k] + 0.7);
  });
}

ExplainedLog explained(Log log) {
  return explain_faults(on_grid(std::move(log)), scara_model(), evidence_limits({}));
}

const DayEffect* ripple_of(const ExplainedLog& log, Joint joint) {
  for (const DayEffect& effect : log.day)
    if (effect.kind == DayEffectKind::torque_ripple && effect.joint == joint) return &effect;
  return nullptr;
}

TEST(DayRipples, ARippleOfALogIsAnEffectOfItsDay) {
  const ExplainedLog log =
      explained(with_ripple(simulate_closed_form(of_day(0), run_of(19)), 2_joint, 60.0, 0.5));
  EXPECT_TRUE(log.faults.empty());
  const DayEffect* ripple = ripple_of(log, 2_joint);
  ASSERT_NE(ripple, nullptr);
  EXPECT_NEAR(ripple->value, 0.5, 0.02);
  EXPECT_LT(ripple->std, 0.02);
  EXPECT_EQ(ripple_of(log, 1_joint), nullptr);
  EXPECT_LT(log.loudness[1], kLoud);
}

TEST(DayRipples, TwoRipplesOfAJointAreOneEffect) {
  Log log = with_ripple(simulate_closed_form(of_day(1), run_of(22)), 2_joint, 60.0, 0.5);
  const ExplainedLog both = explained(with_ripple(std::move(log), 2_joint, 95.0, 0.3));
  const DayEffect* ripple = ripple_of(both, 2_joint);
  ASSERT_NE(ripple, nullptr);
  EXPECT_NEAR(ripple->value, std::hypot(0.5, 0.3), 0.03);
  EXPECT_LT(both.loudness[1], kLoud);
}

TEST(DayRipples, ASlowRippleOfASlidingJointIsFound) {
  const ExplainedLog log =
      explained(with_ripple(simulate_closed_form(of_day(0), run_of(23)), 3_joint, 80.0, 0.6));
  ASSERT_NE(ripple_of(log, 3_joint), nullptr);
  EXPECT_NEAR(ripple_of(log, 3_joint)->value, 0.6, 0.05);
}

TEST(DayRipples, AFaultBesideARippleIsFound) {
  const Log healthy = with_ripple(simulate_closed_form(of_day(0), run_of(20)), 2_joint, 60.0, 0.5);
  const ExplainedLog log = explained(with_loss(healthy, 2_joint, 0.2, 5.0));
  ASSERT_EQ(log.faults.size(), 1U);
  EXPECT_EQ(log.faults[0].label(), (FaultLabel{FaultKind::torque_loss, 2_joint}));
  EXPECT_NEAR(log.faults[0].claim.onset_s, 5.0, 0.05);
  EXPECT_NE(ripple_of(log, 2_joint), nullptr);
}

TEST(DayRipples, ARippleThatBeginsInTheLogIsAFault) {
  const ExplainedLog log =
      explained(with_ripple(simulate_closed_form(of_day(0), run_of(24)), 2_joint, 60.0, 1.0, 4.0));
  EXPECT_FALSE(log.faults.empty());
  EXPECT_EQ(ripple_of(log, 2_joint), nullptr);
}

TEST(DayRipples, AHealthyLogHasNoRipple) {
  EXPECT_FALSE(with_ripples_of_day(on_grid(simulate_closed_form(of_day(2), run_of(21))), scara_model()));
}

}  // namespace
}  // namespace faultline
