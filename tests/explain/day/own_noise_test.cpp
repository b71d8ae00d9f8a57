// SPDX-License-Identifier: MIT
// Noise of single logs of a robot in closed form, and faults beside it.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/explain/decide_log.hpp"
#include "lib/explain/explain.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::changed;
using testing::ClosedFormRun;
using testing::fit_of;
using testing::of_day;
using testing::on_grid;
using testing::run_of;
using testing::scara_model;
using testing::simulate_closed_form;

std::optional<ExplainedFault> decided(const LogFit& fit) {
  return decide_log(explain_log(fit), evidence_limits({}));
}

/// A torque that repeats with the position of joint 2, as that of a gear, from the first sample on.
Log with_cogging(Log log) {
  for (int k = 0; k < log.rows(); ++k) log.tau[1][k] += 0.5 * std::sin(60.0 * log.q[1][k]);
  return log;
}

TEST(ExplainLog, ResidualsFromTheFirstRowOnAreNoiseOfTheLog) {
  const LogFit fit = fit_of(with_cogging(simulate_closed_form(of_day(0), run_of(19))));
  const double usual = autocovariance(scara_model().noise.joint[1])[0];
  EXPECT_GT(autocovariance(fit.noise().joint[1])[0], 4.0 * usual);
  EXPECT_FALSE(decided(fit));
}

TEST(ExplainLog, LoadFrictionThatNoHealthyLogHadIsAnEffectOfTheDay) {
  testing::ClosedFormScara scara = of_day(0);
  scara.load = {0.05, 0.05, 0.05};
  const LogFit fit = fit_of(simulate_closed_form(scara, run_of(33)));
  const DayLayout day = day_layout(fit.model());
  for (int j = 0; j < 2; ++j) {
    EXPECT_NEAR(fit.healthy().day[day.load(j)], 0.05, 0.01) << j;
    EXPECT_LT(fit.noise().joint[j].innovation, 2.0 * scara_model().noise.joint[j].innovation) << j;
  }
}

TEST(ExplainLog, AFaultThatBeginsSoonAfterTheFirstMotionIsNotNoise) {
  Log log = simulate_closed_form(of_day(0), run_of(27));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] > 1.8) log.tau[2][k] *= 40.0;
  const LogFit fit = fit_of(std::move(log));
  EXPECT_LT(fit.noise().joint[2].innovation, 2.0 * scara_model().noise.joint[2].innovation);
}

/// Joint 1 is pushed from before the log on: what pushes spares the drive.
LogFit fit_of_pushed_start() {
  return fit_of(changed(simulate_closed_form(of_day(0), run_of(28)), 0.0, 0.4,
                        [](Log& l, int k) { l.tau[0][k] -= 3.0; }));
}

TEST(ExplainLog, AShortFaultFromTheFirstRowOnIsNotNoise) {
  EXPECT_LT(fit_of_pushed_start().noise().joint[0].innovation, 1.5 * scara_model().noise.joint[0].innovation);
}

TEST(ExplainLog, APushFromBeforeTheLogIsFound) {
  const auto fault = decided(fit_of_pushed_start());
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::collision, 1_joint}));
}

TEST(ExplainLog, AFaultInANoisyLogIsFound) {
  Log log = with_cogging(simulate_closed_form(of_day(0), run_of(20)));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= 4.0) log.tau[0][k] /= 0.5;
  const LogFit fit = fit_of(std::move(log));
  const auto fault = decided(fit);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::torque_loss, 1_joint}));
}

TEST(ExplainLog, AFaultSoonAfterTheStartIsNotNoiseOfItsLog) {
  ClosedFormRun run = run_of(31);
  run.loaded_from_s = 1.5;
  run.load_kg = 0.05;
  const UniformLog log = on_grid(simulate_closed_form(of_day(1), run));
  const ExplainedFit own =
      explain_with_own_noise(log, scara_model(), {}, [](const LogFit& fit) { return explain_log(fit); });
  const FaultHypothesis& best = own.explanation.best.front();
  EXPECT_EQ(FaultLabel(best.kind, best.joint), (FaultLabel{FaultKind::payload_change, 2_joint}));
  EXPECT_GT(best.gain, 1e4);
  EXPECT_NEAR(best.onset_s, run.loaded_from_s, 0.02);
  EXPECT_EQ(own.fit.noise(), scara_model().noise);
}

TEST(ExplainLog, ALogWithLittleNoiseHasTheNoiseOfTheHealthyLogs) {
  const LogFit fit = fit_of(simulate_closed_form(of_day(1), run_of(21)));
  for (int j = 0; j < 3; ++j)
    EXPECT_LT(autocovariance(fit.noise().joint[j])[0], 1.5 * autocovariance(scara_model().noise.joint[j])[0]);
}

}  // namespace
}  // namespace faultline
