// SPDX-License-Identifier: MIT
#include "lib/explain/several_pushes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::changed;
using testing::fit_of;
using testing::of_day;
using testing::run_of;
using testing::simulate_closed_form;

constexpr double kPush = 3.0, kLasts_s = 0.3;  // N m, at its middle

/// Returns a log in which joint 2 is pushed at these moments: what pushes spares the drive.
Log pushed_at(const std::vector<double>& onsets_s) {
  Log log = simulate_closed_form(of_day(0), run_of(41));
  for (const double onset_s : onsets_s)
    log = changed(std::move(log), onset_s, onset_s + kLasts_s, [onset_s](Log& l, int k) {
      l.tau[1][k] -= kPush * std::sin(std::numbers::pi * (l.time[k] - onset_s) / kLasts_s);
    });
  return log;
}

EvidenceLimits limits() { return evidence_limits({}); }

TEST(SeveralPushes, AreFoundOneByOne) {
  const std::vector<double> onsets_s = {3.0, 4.6, 6.2};
  const std::vector<ExplainedFault> found = several_pushes(fit_of(pushed_at(onsets_s)), limits(), 12, 0.0);
  ASSERT_EQ(found.size(), onsets_s.size());
  for (const double onset_s : onsets_s)
    EXPECT_TRUE(std::ranges::any_of(found, [&](const ExplainedFault& fault) {
      return fault.label() == FaultLabel{FaultKind::collision, 2_joint} &&
             std::abs(fault.claim.onset_s - onset_s) < 0.03;
    })) << onset_s;
}

TEST(SeveralPushes, AreNoneInAHealthyLog) {
  EXPECT_TRUE(several_pushes(fit_of(pushed_at({})), limits(), 12, 0.0).empty());
}

TEST(SeveralPushes, AreNoneIfAnotherFaultExplainsMore) {
  EXPECT_TRUE(several_pushes(fit_of(pushed_at({3.0, 4.6, 6.2})), limits(), 12, 1e9).empty());
}

}  // namespace
}  // namespace faultline
