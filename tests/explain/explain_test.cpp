// SPDX-License-Identifier: MIT
// A robot in closed form, apart from the library's dynamics, is learned from three healthy days and
// explained.
#include "lib/explain/explain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/classify/episode_features.hpp"
#include "lib/explain/decide_log.hpp"
#include "lib/explain/explain_faults.hpp"
#include "lib/explain/refine.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::ClosedFormRun;
using testing::ClosedFormScara;
using testing::fit_of;
using testing::kExplainedPeriod_s;
using testing::learned_from;
using testing::of_day;
using testing::run_of;
using testing::scara_model;
using testing::simulate_closed_form;

std::optional<ExplainedFault> decided(const LogFit& fit) {
  return decide_log(explain_log(fit), evidence_limits({}));
}

EvidenceLimits limits() { return evidence_limits({}); }

TEST(FitDays, GivesTheRobotOfTheClosedForm) {
  const ClosedFormScara truth;
  const ColumnLayout layout = scara_model().layout();
  const std::vector<double> base = {truth.a(), truth.b(), truth.c(), truth.m3};
  for (int p = 0; p < 4; ++p) EXPECT_NEAR(scara_model().theta[p] / base[p], 1.0, 0.01) << p;
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(scara_model().theta[layout.viscous(j)] / truth.fv[j], 1.0, 0.1) << j;
    EXPECT_NEAR(scara_model().theta[layout.coulomb(j)] / truth.fc[j], 1.0, 0.1) << j;
  }
}

/// A day at 1 kHz.
Log fine_day(int day, std::uint64_t seed) {
  ClosedFormRun run = run_of(seed);
  run.period_s = 0.001;
  run.duration_s = 5.0;
  return simulate_closed_form(of_day(day), run);
}

TEST(FitDays, AFaultInAveragedSamplesIsFoundWithItsOnsetAndSize) {
  const BalanceModel model = learned_from({fine_day(0, 1), fine_day(1, 2), fine_day(2, 3)}).model;
  const ClosedFormScara truth;
  const std::vector<double> base = {truth.a(), truth.b(), truth.c(), truth.m3};
  EXPECT_EQ(model.setting.averaged, 2);
  for (int p = 0; p < 4; ++p) EXPECT_NEAR(model.theta[p] / base[p], 1.0, 0.01) << p;
  for (int j = 0; j < 3; ++j)
    EXPECT_NEAR(model.theta[model.layout().delay(j)] + model.setting.torque_lag, 0.0, 0.1) << j;
  Log log = fine_day(1, 4);
  for (int k = 3000; k < log.rows(); ++k) log.tau[0][k] /= 0.6;
  MemorySource source(std::move(log));
  const auto faults = explain_whole_log(uniform_log(source, 0.001), {model, limits()}).faults;
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].label(), (FaultLabel{FaultKind::torque_loss, 1_joint}));
  EXPECT_NEAR(faults[0].claim.onset_s, 3.0, 0.01);
  EXPECT_NEAR(faults[0].claim.size[0], 0.4, 0.04);
}

TEST(FitDays, TheFrictionOfADayIsAnEffectOfTheDay) {
  const DayLayout day = day_layout(scara_model());
  const LogFit fit = fit_of(simulate_closed_form(of_day(2), run_of(9)));
  for (int j = 0; j < 3; ++j) EXPECT_NEAR(fit.healthy().day[day.friction(j)], 0.04, 0.03) << j;
}

TEST(FitDays, TheRobotFittedWithoutADayDoesNotDependOnThatDay) {
  std::vector<Log> days;
  for (int day = 0; day < 4; ++day) {
    ClosedFormScara robot = of_day(day);
    if (day == 2) robot.m3 *= 1.1;
    days.push_back(simulate_closed_form(robot, run_of(day + 1)));
  }
  const FittedDays fit = learned_from(days);
  ASSERT_EQ(fit.without.size(), days.size());
  const double mass = ClosedFormScara{}.m3;
  EXPECT_NEAR(fit.without[2].theta[3] / mass, 1.0, 0.005);
  EXPECT_GT(fit.model.theta[3] / mass, 1.01);
  EXPECT_GT(fit.without[0].theta[3] / mass, 1.01);
}

TEST(ExplainLog, AHealthyDayGivesNoEvidence) {
  const LogFit fit = fit_of(simulate_closed_form(of_day(2), run_of(11)));
  const LogExplanation e = explain_log(fit);
  for (const FaultHypothesis& h : e.best) EXPECT_LT(h.gain, 20.0) << to_string(h.kind);
  EXPECT_LT(e.healthy_square, 1.5);
  EXPECT_FALSE(decide_log(e, limits()));
}

TEST(ExplainLog, ATorqueLossIsFoundWithJointOnsetAndSize) {
  Log log = simulate_closed_form(of_day(0), run_of(12));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= 4.0) log.tau[1][k] /= 0.7;  // 30 % of it do not reach the joint
  const LogFit fit = fit_of(std::move(log));
  const auto fault = decided(fit);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::torque_loss, 2_joint}));
  EXPECT_NEAR(fault->claim.onset_s, 4.0, 0.03);
  EXPECT_NEAR(fault->claim.size[0], 0.3, 0.03);
  EXPECT_GE(fault->alarm_s, fault->claim.onset_s);
  EXPECT_LT(fault->alarm_s, 5.0);
}

TEST(ExplainLog, TorqueThatIsLostDoesNotDeflectAGear) {
  BalanceModel soft = scara_model();
  const int spring = soft.layout().spring(1);
  soft.theta[spring] = 2e-4;  // s^2 kg m^2 / (N m)
  const UniformLog log = testing::on_grid(simulate_closed_form(of_day(0), run_of(12)));
  const BalanceRows rows = balance_rows(log, soft.setting, soft.rigid, soft.theta);
  const auto faults = linear_faults(rows, soft);
  const LinearFault* loss = linear_of(faults, {FaultKind::torque_loss, 2_joint});
  ASSERT_TRUE(loss);
  // The balance of the robot with the whole torque less that of one with no torque at joint 2.
  UniformLog without = log;
  without.tau.col(1).setZero();
  const BalanceRows lost = balance_rows(without, soft.setting, soft.rigid, soft.theta);
  for (int j = 0; j < 3; ++j) {
    const Eigen::VectorXd with_torque = rows.torque.col(j) - rows.column[j] * soft.theta,
                          without_it = lost.torque.col(j) - lost.column[j] * soft.theta;
    const Eigen::VectorXd column = loss->columns.column.col(0).segment(j * rows.rows(), rows.rows());
    EXPECT_LT((with_torque - without_it - column).norm(), 1e-4 * column.norm() + 1e-9)
        << j;  // but for a delay
  }
}

TEST(ExplainLog, AFalsePositionIsFoundWithItsSize) {
  Log log = simulate_closed_form(of_day(0), run_of(13));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= 3.0) log.q[1][k] += 0.05;
  const LogFit fit = fit_of(std::move(log));
  const auto fault = decided(fit);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::sensor_bias, 2_joint}));
  EXPECT_NEAR(fault->claim.size[0], 0.05, 0.003);
  EXPECT_NEAR(fault->claim.onset_s, 3.0, 0.01);
}

TEST(ExplainLog, AJumpOfAPositionIsFoundIfTheVelocityIsComputedFromIt) {
  Log log = simulate_closed_form(of_day(0), run_of(13));
  double filtered = 0.0;  // what the jump adds to a difference of the positions behind a filter of 40 Hz
  for (int k = 0; k < log.rows(); ++k) {
    const bool jumps = log.time[k] >= 3.0 && log.time[k] < 3.0 + kExplainedPeriod_s - 1e-9;
    filtered += 0.5 * ((jumps ? 0.05 / kExplainedPeriod_s : 0.0) - filtered);
    log.dq[1][k] += filtered;
    if (log.time[k] >= 3.0) log.q[1][k] += 0.05;
  }
  const auto fault = decided(fit_of(std::move(log)));
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::sensor_bias, 2_joint}));
  EXPECT_NEAR(fault->claim.size[0], 0.05, 0.003);
  EXPECT_NEAR(fault->claim.onset_s, 3.0, 0.01);
  EXPECT_FALSE(fault->claim.velocity_is_true);
}

TEST(ExplainLog, AShortForceIsACollision) {
  Log log = simulate_closed_form(of_day(0), run_of(14));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= 5.0 && log.time[k] < 5.1) log.tau[1][k] -= 4.0;  // what pushes spares the drive
  const LogFit fit = fit_of(std::move(log));
  const auto fault = decided(fit);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::collision, 2_joint}));
  EXPECT_NEAR(fault->claim.onset_s, 5.0, 0.03);
  EXPECT_NEAR(impulse_of(fault->claim, 1, 3), 0.4, 0.1);
}

TEST(ExplainLog, AMassOnAnInnerLinkIsNamedWithTheLinkAndItsSize) {
  ClosedFormRun run = run_of(11);
  run.loaded_from_s = 4.0;
  run.load_kg = 0.2;
  const std::optional<ExplainedFault> fault = decided(fit_of(simulate_closed_form(of_day(1), run)));
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::payload_change, 2_joint}));
  EXPECT_NEAR(fault->claim.size[0], 0.2, 0.02);
  EXPECT_NEAR(fault->claim.onset_s, 4.0, 0.02);
}

TEST(ExplainLog, AFaultOfNoKnownKindIsUnknown) {
  Log log = simulate_closed_form(of_day(0), run_of(15));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= 4.0) log.tau[1][k] += 4.0 * std::sin(9.0 * log.time[k]) * std::sin(23.0 * log.time[k]);
  const LogFit fit = fit_of(std::move(log));
  const auto fault = decided(fit);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->claim.kind, FaultKind::unknown);
  EXPECT_NEAR(fault->claim.onset_s, 4.0, 0.15);
}

/// Vibration of joint 2 from 4 s on, N m.
LogFit with_vibration(double amplitude) {
  return fit_of(testing::changed(simulate_closed_form(of_day(0), run_of(16)), 4.0, kNeverEnds,
                                 [amplitude](Log& log, int k) {
                                   log.tau[1][k] += amplitude * std::sin(2.0 * M_PI * 17.0 * log.time[k]);
                                 }));
}

TEST(ExplainLog, AVibrationOfWhichAPushExplainsOnePeriodIsUnknown) {
  const auto fault = decided(with_vibration(1.0));
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::unknown, 2_joint}));
  EXPECT_NEAR(fault->claim.onset_s, 4.0, 0.15);
  EXPECT_NEAR(fault->alarm_s, 4.5, 0.5);
}

TEST(ExplainLog, AVibrationThatNoKnownFaultExplainsAtAllIsUnknown) {
  const LogFit fit = with_vibration(0.8);
  const LogExplanation e = explain_log(fit);
  ASSERT_TRUE(named_faults(e, limits(), 1).empty());
  const auto fault = decide_log(e, limits());
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::unknown, 2_joint}));
  EXPECT_NEAR(fault->claim.onset_s, 4.0, 0.15);
  EXPECT_NEAR(fault->alarm_s, 4.5, 0.5);
  EXPECT_GT(fault->evidence, fault->limit);
}

TEST(ExplainLog, TheRowsOfOnePushHoldAPartOfTheEvidenceOfAFaultThatLasts) {
  const LogExplanation e =
      explain_log(fit_of(testing::with_loss(simulate_closed_form(of_day(0), run_of(17)), 2_joint, 0.3, 3.0)));
  ASSERT_FALSE(e.best.empty());
  EXPECT_GT(e.most_of_a_push, 0.05 * e.best.front().gain);
  EXPECT_LT(e.most_of_a_push, 0.9 * e.best.front().gain);
}

TEST(ExplainLog, FrictionThatGrowsSlowlyIsAFrictionIncrease) {
  Log log = simulate_closed_form(of_day(0), run_of(17));
  for (int k = 0; k < log.rows(); ++k)  // what the drive must give beyond that of the healthy joint
    if (log.time[k] >= 3.0) log.tau[1][k] += (log.time[k] - 3.0) * 0.4 * std::tanh(log.dq[1][k] / 0.05);
  const LogFit fit = fit_of(std::move(log));
  const auto fault = decided(fit);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::friction_increase, 2_joint}));
  EXPECT_TRUE(fault->claim.grows);
  EXPECT_NEAR(fault->claim.onset_s, 3.0, 0.3);
  EXPECT_NEAR(fault->claim.size[1], 0.4, 0.1);
}

TEST(ExplainLog, APushThatSwellsAndFadesIsACollision) {
  Log log = simulate_closed_form(of_day(0), run_of(18));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= 4.0 && log.time[k] < 4.8)
      log.tau[1][k] -= 3.0 * std::sin(M_PI * (log.time[k] - 4.0) / 0.8);
  const LogFit fit = fit_of(std::move(log));
  const auto fault = decided(fit);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::collision, 2_joint}));
  EXPECT_NEAR(fault->claim.end_s - fault->claim.onset_s, 0.8, 0.2);
}

/// A torque on joint 2 that the drive is spared from 4 s on.
Log with_torque_on_joint_2(double end_s, std::uint64_t seed) {
  return testing::changed(simulate_closed_form(of_day(0), run_of(seed)), 4.0, end_s,
                          [](Log& log, int k) { log.tau[1][k] -= 2.5; });
}

TEST(ExplainLog, AConstantTorqueOnOneJointIsAPushIfItIsShort) {
  const auto fault = decided(fit_of(with_torque_on_joint_2(4.3, 19)));
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::collision, 2_joint}));
  EXPECT_NEAR(fault->claim.end_s, 4.3, 0.02);
}

TEST(ExplainLog, AConstantTorqueOnOneJointIsAnOffsetIfItLasts) {
  const auto fault = decided(fit_of(with_torque_on_joint_2(6.5, 20)));
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::torque_sensor_error, 2_joint}));
}

TEST(ExplainLog, ADriveThatLimitsItsTorqueIsAnUnknownFault) {
  ClosedFormRun run = run_of(22);
  run.clips_from_s = 3.0;
  run.clip[1] = 4.0;
  const LogFit fit = fit_of(simulate_closed_form(of_day(0), run));
  const auto fault = decided(fit);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->claim.kind, FaultKind::unknown);
  EXPECT_NEAR(fault->claim.onset_s, 3.0, 0.3);
}

/// Joint 2 locks at 4 s, which shakes joint 1 on a soft spring for a while.
Log with_lock(std::uint64_t seed) {
  ClosedFormRun run = run_of(seed);
  run.locks_from_s = 4.0;
  Log log = simulate_closed_form(of_day(0), run);
  for (int k = 0; k < log.rows(); ++k)
    if (const double since = log.time[k] - 4.0; since > 0.0)
      log.tau[0][k] += 8.0 * std::exp(-since / 0.8) * std::sin(60.0 * since);
  return log;
}

TEST(ExplainLog, ALockThatShakesTheOtherJointsIsOneFault) {
  MemorySource source(with_lock(23));
  const ExplainedLog log =
      explain_faults(uniform_log(source, kExplainedPeriod_s), scara_model(), limits(), {});
  ASSERT_EQ(log.faults.size(), 1u);
  EXPECT_EQ(log.faults[0].label(), (FaultLabel{FaultKind::locked, 2_joint}));
  EXPECT_NEAR(log.faults[0].claim.onset_s, 4.0, 0.05);
}

TEST(ExplainLog, ALockedJointWithACoarseEncoderIsNotAStuckEncoder) {
  Log log = with_lock(24);
  for (int k = 1001; k < log.rows(); ++k) log.q[1][k] = log.q[1][1000];  // too coarse to show any noise
  const auto fault = decided(fit_of(std::move(log)));
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::locked, 2_joint}));
}

TEST(ExplainLog, AFilteredVelocityThatDecaysBelongsToAStuckEncoder) {
  Log log = simulate_closed_form(of_day(0), run_of(26));
  const double speed = log.dq[1][1000];
  for (int k = 1001; k < log.rows(); ++k) {
    log.q[1][k] = log.q[1][1000];
    log.dq[1][k] = speed * std::exp(-kExplainedPeriod_s * (k - 1000) / 0.01);
  }
  const auto fault = decided(fit_of(std::move(log)));
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::stuck_encoder, 2_joint}));
}

TEST(ExplainLog, AJumpOfASlidingPositionIsFoundByItsVelocity) {
  Log log = simulate_closed_form(of_day(0), run_of(25));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= 3.0) log.q[2][k] += 0.0006;  // the torque hardly shows it: nothing depends on it
  const auto fault = decided(fit_of(std::move(log)));
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->label(), (FaultLabel{FaultKind::sensor_bias, 3_joint}));
  EXPECT_NEAR(fault->claim.size[0], 0.0006, 1e-4);
  EXPECT_GT(fault->alarm_s, 3.0 - kExplainedPeriod_s);
}

/// The wrong torque of a sensor is not constant, so that its column leaves a part of it in each row.
TEST(Misfit, DoesNotDependOnWhichSideOfARowAFaultEnds) {
  constexpr double kEnd_s = 3.4;
  const LogFit fit =
      fit_of(testing::changed(simulate_closed_form(of_day(0), run_of(21)), 3.0, kEnd_s, [](Log& log, int k) {
        log.tau[1][k] += 6.0 * (1.0 + 0.3 * std::sin(60.0 * log.time[k]));
      }));
  const FreeForm change = free_form(fit);
  const double edge_s = reach_s(fit.model().setting);
  for (int row = fit.first_row(kEnd_s); row < fit.first_row(kEnd_s + 2.0 * edge_s); ++row) {
    JudgedHypotheses judged{fit};
    std::vector<double> nats;
    for (const double moved_s : {-1e-9, 1e-9}) {
      const double end_s = fit.time_s()[row] - edge_s + moved_s;
      const std::optional<FaultHypothesis> h =
          judged.go({FaultKind::torque_sensor_error, 2_joint, 3.0, end_s, {}});
      ASSERT_TRUE(h);
      nats.push_back(misfit(fit, change, *h));
    }
    EXPECT_NEAR(nats[0], nats[1], 150.0) << row;  // thousands if the rows after the end count as noise
  }
}

TEST(ExplainLog, ALockThatLeavesASmallShareOfALargeResidualSuffices) {
  ExplainedFault fault;
  fault.claim.kind = FaultKind::locked;
  fault.misfit = 5000.0;
  fault.residual_share = 0.02;
  EXPECT_TRUE(has_large_misfit(fault));
  EXPECT_TRUE(suffices(fault));
  fault.residual_share = 0.1;
  EXPECT_FALSE(suffices(fault));
  fault.claim.kind = FaultKind::torque_loss;
  fault.residual_share = 0.02;
  EXPECT_FALSE(suffices(fault));
}

TEST(ExplainLog, TheSameLogGivesTheSameBytes) {
  const Log log = simulate_closed_form(of_day(2), run_of(16));
  const LogExplanation a = explain_log(fit_of(log)), b = explain_log(fit_of(log));
  ASSERT_EQ(a.best.size(), b.best.size());
  for (std::size_t k = 0; k < a.best.size(); ++k) EXPECT_EQ(a.best[k].gain, b.best[k].gain);
}

}  // namespace
}  // namespace faultline
