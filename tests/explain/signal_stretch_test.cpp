// SPDX-License-Identifier: MIT
// Stretches in which a drive or a controller contradicts itself, of a robot in closed form.
#include "lib/explain/signal_stretch.hpp"

#include <gtest/gtest.h>

#include "lib/explain/explain_faults.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::changed;
using testing::fit_of;
using testing::of_day;
using testing::on_grid;
using testing::run_of;
using testing::scara_model;
using testing::simulate_closed_form;
using testing::with_loss;

const FaultLabel kSensor1{FaultKind::torque_sensor_error, 1_joint};

Log healthy(std::uint64_t seed) { return simulate_closed_form(of_day(0), run_of(seed)); }

/// Joint 1 is asked for another torque than its drive gives.
SignalStretch drive(double onset_s, double end_s, double nats = 1000.0) {
  return {.joint = 1_joint,
          .onset_s = onset_s,
          .alarm_s = onset_s + 0.02,
          .end_s = end_s,
          .nats = nats,
          .limit = 20.0};
}

SignalStretch law(double onset_s, double end_s) {
  SignalStretch out = drive(onset_s, end_s);
  out.pair = SignalPair::control_law;
  out.joint = 2_joint;
  return out;
}

FaultLabel label_of(const SignalStretch& stretch, const LogFit* fit = nullptr) {
  return judge_stretch(stretch, fit).fault.label();
}

TEST(SignalStretch, AMissingShareOfTheTorqueIsALossIfAnOffsetExplainsLess) {
  SignalStretch lost = drive(3.0, kNeverEnds);
  lost.loss = 0.4;
  lost.loss_explains = 0.9;
  lost.offset_explains = 0.5;
  EXPECT_EQ(label_of(lost), (FaultLabel{FaultKind::torque_loss, 1_joint}));
  EXPECT_EQ(judge_stretch(lost, nullptr).fault.claim.size[0], 0.4);
  lost.offset_explains = 0.85;
  EXPECT_EQ(label_of(lost), (FaultLabel{FaultKind::unknown, 1_joint}));
  lost.loss = 0.95;
  lost.offset_explains = 0.0;
  EXPECT_EQ(label_of(lost), (FaultLabel{FaultKind::free_swinging, 1_joint}));
}

TEST(SignalStretch, TheTorqueBalanceAddsItsEvidenceForALoss) {
  SignalStretch lost = drive(4.0, kNeverEnds);
  lost.loss = 0.3;
  lost.loss_explains = 0.45;
  const LogFit loses = fit_of(with_loss(healthy(41), 1_joint, 0.3, 4.0));
  const JudgedStretch both = judge_stretch(lost, &loses);
  EXPECT_EQ(both.fault.label(), (FaultLabel{FaultKind::torque_loss, 1_joint}));
  EXPECT_GT(both.in_balance, 100.0);
  EXPECT_NEAR(both.fault.evidence, 0.45 * lost.nats + both.in_balance, 1e-6);
  EXPECT_NEAR(both.fault.claim.size[0], 0.3, 0.03);
}

TEST(SignalStretch, ALossThatTheTorqueBalanceContradictsIsAnErrorOfTheSensor) {
  SignalStretch lost = drive(4.0, kNeverEnds);
  lost.loss = 0.3;
  lost.loss_explains = 0.95;
  const LogFit is_healthy = fit_of(healthy(41));
  const ExplainedFault of_sensor = judge_stretch(lost, &is_healthy).fault;
  EXPECT_EQ(of_sensor.label(), kSensor1);
  EXPECT_EQ(of_sensor.evidence, 0.95 * lost.nats) << "the torque balance shows nothing";
  const ExplainedFault unbalanced = judge_stretch(drive(4.0, kNeverEnds), nullptr).fault;
  EXPECT_EQ(unbalanced.label(), (FaultLabel{FaultKind::unknown, 1_joint}));
  EXPECT_EQ(unbalanced.could_also_be, std::vector{kSensor1}) << "no motion decides between drive and sensor";
}

TEST(SignalStretch, AnOffsetIsOfTheSensorIfTheMotionFitsTheCommand) {
  SignalStretch off = drive(4.0, kNeverEnds);
  off.offset = 6.0;
  off.offset_explains = 0.95;
  const LogFit fits = fit_of(healthy(42)),
               drive_gives_more =
                   fit_of(changed(healthy(42), 4.0, kNeverEnds, [](Log&l, int k) { l.tau[0][k] -= 6.0; }));
  const ExplainedFault of_sensor = judge_stretch(off, &fits).fault;
  EXPECT_EQ(of_sensor.label(), kSensor1);
  EXPECT_EQ(of_sensor.claim.size[0], 6.0);
  EXPECT_EQ(label_of(off, &drive_gives_more), (FaultLabel{FaultKind::unknown, 1_joint}));
  off.offset = 0.01;
  EXPECT_EQ(label_of(off, &fits), (FaultLabel{FaultKind::unknown, 1_joint}))
      << "too small for the motion to show";
}

TEST(SignalStretch, TimesOfALossAreThoseThatTheTorqueBalanceExplainsBest) {
  SignalStretch lost = drive(4.08, 5.2);
  lost.loss = 0.3;
  lost.loss_explains = 0.9;
  const LogFit ends = fit_of(with_loss(healthy(46), 1_joint, 0.3, 4.0, 5.0));
  const FaultClaim claim = judge_stretch(lost, &ends).fault.claim;
  EXPECT_NEAR(claim.onset_s, 4.0, 0.03);
  EXPECT_NEAR(claim.end_s, 5.0, 0.03);
  EXPECT_NEAR(claim.size[0], 0.3, 0.05);
}

TEST(SignalStretch, ASensorWithAnOffsetShowsInTheBalanceOfItsMeasurements) {
  SignalStretch off = drive(4.0, kNeverEnds);
  off.offset_explains = 0.95;
  off.balance_is_of_command = false;
  const LogFit shows =
                   fit_of(changed(healthy(42), 4.0, kNeverEnds, [](Log&l, int k) { l.tau[0][k] += 6.0; })),
               is_healthy = fit_of(healthy(42));
  EXPECT_EQ(label_of(off, &shows), kSensor1);
  const ExplainedFault of_drive = judge_stretch(off, &is_healthy).fault;
  EXPECT_EQ(of_drive.label(), (FaultLabel{FaultKind::unknown, 1_joint}));
  EXPECT_EQ(of_drive.could_also_be, std::vector{kSensor1});
  off.end_s = 4.2;
  EXPECT_TRUE(judge_stretch(off, &is_healthy).fault.could_also_be.empty()) << "an offset of a sensor lasts";
}

TEST(SignalStretch, ALongDeviationFromTheLawAfterAFaultIsTheControllersResponse) {
  const auto reported = [](const SignalStretch& stretch, const FaultClaim& fault) {
    return judged_stretches({stretch}, {}, {fault}, nullptr).size();
  };
  const FaultClaim ended{FaultKind::locked, 1_joint, 2.0, 3.0}, lasts{FaultKind::locked, 1_joint, 2.0};
  EXPECT_EQ(reported(law(4.0, 9.0), ended), 0u);
  EXPECT_EQ(reported(law(4.0, 4.5), lasts), 0u);
  EXPECT_EQ(reported(law(4.0, 4.5), ended), 1u) << "short, and behind the end of the fault";
  EXPECT_EQ(reported(law(1.0, 9.0), lasts), 1u) << "the law changed first";
}

TEST(SignalStretch, ADriveThatLagsBehindAJumpOfAMeasurementHasNoFault) {
  ExplainedFault jump;
  jump.claim = {FaultKind::sensor_bias, 1_joint, 4.0};
  jump.evidence = 5000.0;
  EXPECT_TRUE(judged_stretches({drive(4.0, 4.1, 42.0)}, {jump}, {}, nullptr).empty());
  EXPECT_EQ(judged_stretches({drive(4.0, 4.1, 9000.0)}, {jump}, {}, nullptr).size(), 1u);
  EXPECT_EQ(judged_stretches({drive(6.0, 6.1, 42.0)}, {jump}, {}, nullptr).size(), 1u);
}

/// Joint 1 is pushed by a torque that nobody asked for, from 4 to 4.3 s.
Log pushed(std::uint64_t seed) {
  return changed(healthy(seed), 4.0, 4.3, [](Log& l, int k) { l.tau[0][k] -= 8.0; });
}

ExplainedLog explained(Log log, std::vector<SignalStretch> begin) {
  return explain_faults(on_grid(std::move(log)), scara_model(), evidence_limits({}), {},
                        {.begin = std::move(begin)});
}

TEST(SignalStretch, AFaultOfADriveThatTheTorqueBalanceShowsIsNotASecondFault) {
  ASSERT_FALSE(explained(pushed(43), {}).faults.empty());
  const ExplainedLog out = explained(pushed(43), {drive(4.0, 4.3)});
  EXPECT_TRUE(out.faults.empty());
  ASSERT_EQ(out.stretches.size(), 1u);
  EXPECT_EQ(out.stretches[0].fault.label(), (FaultLabel{FaultKind::unknown, 1_joint}));
  EXPECT_GT(out.stretches[0].in_balance, 50.0) << "both rows show it";
}

TEST(SignalStretch, AFurtherFaultIsFoundDuringAFaultOfADrive) {
  for (const double end_s : {4.3, kNeverEnds}) {
    Log log = changed(healthy(44), 4.0, end_s, [](Log& l, int k) { l.tau[0][k] -= 8.0; });
    log = changed(std::move(log), 6.0, kNeverEnds, [](Log& l, int k) { l.q[1][k] += 0.05; });
    const ExplainedLog out = explained(std::move(log), {drive(4.0, end_s)});
    ASSERT_EQ(out.stretches.size(), 1u);
    ASSERT_EQ(out.faults.size(), 1u);
    EXPECT_EQ(out.faults[0].label(), (FaultLabel{FaultKind::sensor_bias, 2_joint}));
    EXPECT_NEAR(out.faults[0].claim.onset_s, 6.0, 0.02);
  }
}

TEST(SignalStretch, AFaultIsFoundWhileAControlLawDoesNotHold) {
  const ExplainedLog out = explained(with_loss(healthy(45), 1_joint, 0.4, 5.0), {law(3.0, kNeverEnds)});
  ASSERT_EQ(out.stretches.size(), 1u);
  EXPECT_EQ(out.stretches[0].fault.label(), (FaultLabel{FaultKind::unknown, 2_joint}));
  ASSERT_EQ(out.faults.size(), 1u);
  EXPECT_EQ(out.faults[0].label(), (FaultLabel{FaultKind::torque_loss, 1_joint}));
}

/// A stretch in which a drive loses 30 %.
SignalStretch loss(double onset_s, double end_s) {
  SignalStretch out = drive(onset_s, end_s);
  out.loss = 0.3;
  out.loss_explains = 0.9;
  return out;
}

TEST(SignalStretch, ALossThatTheSignalsShowInPartsIsOneFault) {
  const LogFit lasts = fit_of(with_loss(healthy(47), 1_joint, 0.3, 3.0)),
               twice = fit_of(with_loss(with_loss(healthy(47), 1_joint, 0.3, 3.0, 4.0), 1_joint, 0.3, 6.0));
  const auto one = judged_stretches({loss(3.0, 4.0), loss(6.0, kNeverEnds)}, {}, {}, &lasts);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].fault.claim.end_s, kNeverEnds);
  EXPECT_EQ(judged_stretches({loss(3.0, 4.0), loss(6.0, kNeverEnds)}, {}, {}, &twice).size(), 2u);
  EXPECT_EQ(judged_stretches({loss(3.0, 4.0), loss(4.5, 5.0)}, {}, {}, nullptr).size(), 1u);
  EXPECT_EQ(judged_stretches({loss(3.0, 4.0), loss(6.0, 7.0)}, {}, {}, nullptr).size(), 2u)
      << "without a torque balance a second without a difference parts two faults";
}

TEST(SignalStretch, OnlyFaultsThatTheTorqueBalanceShowsAreInItsClaims) {
  SignalStretch lost = loss(3.0, kNeverEnds);
  const LogFit loses = fit_of(with_loss(healthy(48), 1_joint, 0.3, 3.0));
  EXPECT_EQ(balance_claims({judge_stretch(lost, &loses)}).size(), 1u);
  lost.balance_is_of_command = false;
  const LogFit is_healthy = fit_of(healthy(48));
  EXPECT_TRUE(balance_claims({judge_stretch(lost, &is_healthy)}).empty());
}

}  // namespace
}  // namespace faultline
