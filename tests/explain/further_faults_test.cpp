// SPDX-License-Identifier: MIT
#include "lib/explain/further_faults.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/explain/explain.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::changed;
using testing::of_day;
using testing::on_grid;
using testing::run_of;
using testing::scara_model;
using testing::simulate_closed_form;

constexpr double kOnset_s = 2.0;

/// Joint 2 has friction of 4 times the usual level from kOnset_s on; from `since_s` on, a share `miss` of
/// what is added acts in one direction alone.
LogFit fit_beside_friction(double miss, double since_s) {
  const testing::ClosedFormScara robot;
  const double more = 3.0 * robot.fc[1];
  const Log log =
      changed(simulate_closed_form(of_day(0), run_of(31)), kOnset_s, kNeverEnds, [&](Log& l, int k) {
        l.tau[1][k] += more * (std::tanh(l.dq[1][k] / robot.width) + (l.time[k] < since_s ? 0.0 : miss));
      });
  FaultClaim known{FaultKind::friction_increase, 2_joint, kOnset_s};
  known.size = Eigen::Vector2d(0.0, more);
  return LogFit(on_grid(log), scara_model(), {known});
}

TEST(FurtherFaults, AFormErrorOfAKnownFaultIsNone) {
  const LogFit fit = fit_beside_friction(0.03, 3.5);
  const LogExplanation e = explain_log(fit);
  ASSERT_FALSE(named_faults(e, evidence_limits({}), 1).empty());
  EXPECT_TRUE(further_faults(fit, e, evidence_limits({}), 1).empty());
}

TEST(FurtherFaults, AFaultThatExceedsTheFormErrorOfAKnownOneIsFound) {
  const LogFit fit = fit_beside_friction(0.3, 4.5);
  const auto found = further_faults(fit, explain_log(fit), evidence_limits({}), 1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].claim.onset_s, 4.5, 0.1);
}

}  // namespace
}  // namespace faultline
