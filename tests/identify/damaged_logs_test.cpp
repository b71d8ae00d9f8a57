// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

using testing::ClosedFormRun;
using testing::ClosedFormScara;
using testing::simulate_closed_form;

Log good_log() {
  ClosedFormRun run;
  run.period_s = 0.002;
  run.duration_s = 8.0;
  return simulate_closed_form({}, run);
}

/// Base parameters a, b, c and m3 of what is identified from a log must be right within `share`.
void expect_right(const Log& log, double share) {
  const ClosedFormScara scara;
  const double truth[] = {scara.a(), scara.b(), scara.c(), scara.m3};
  MemorySource source(log, "log");
  LogSource* logs[] = {&source};
  Robot robot = preset_robot("RRP");
  robot.log.torque_between_samples = TorqueTiming::held;
  const Identification id = identify(logs, robot);
  EXPECT_EQ(id.status, IdentificationStatus::converged) << id.reason;
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(id.base_parameters[k].value / truth[k], 1.0, share) << id.base_parameters[k].name;
}

TEST(IdentifyDamagedLogs, SpikesInAHundredthOfTheRowsMoveMassesByLessThanAThousandth) {
  Log log = good_log();
  Random random(3);
  for (int k = 0; k < log.rows() / 100; ++k)
    for (JointSignals* signals : {&log.q, &log.dq, &log.tau})
      (*signals)[random.below(3)][random.below(log.time.size())] += random.uniform(-5.0, 5.0);
  expect_right(log, 1e-3);
}

TEST(IdentifyDamagedLogs, LosingOneRowInTwentyChangesNothing) {
  const Log log = good_log();
  Log kept = slice(log, 0, 0);
  Random random(4);
  for (int k = 0; k < log.rows(); ++k)
    if (random.uniform(0.0, 1.0) > 0.05) append(kept, slice(log, k, k + 1));
  expect_right(kept, 3e-4);
}

TEST(IdentifyDamagedLogs, APushOfAThirdOfASecondMovesMassesByLessThanAThousandth) {
  Log log = good_log();
  for (int k = 2000; k < 2150; ++k) log.tau[0][k] -= 15.0;  // what another body gave and no drive logged
  expect_right(log, 1e-3);
}

TEST(IdentifyDamagedLogs, AnEmptyStretchChangesNothing) {
  Log log = good_log();
  for (int k = 1000; k < 1300; ++k)
    for (auto& q : log.q) q[k] = std::numeric_limits<double>::quiet_NaN();
  expect_right(log, 3e-4);
}

}  // namespace
}  // namespace faultline
