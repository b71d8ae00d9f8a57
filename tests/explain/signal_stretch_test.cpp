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

const FaultLabel kSensor1{FaultKind::torque_sensor_error, 1};

Log healthy(std::uint64_t seed) { return simulate_closed_form(of_day(0), run_of(seed)); }

/// Joint 1 is asked for another torque than its drive gives.
SignalStretch drive(double onset_s, double end_s, double nats = 1000.0) {
  return {
      .joint = 1, .onset_s = onset_s, .alarm_s = onset_s + 0.02, .end_s = end_s, .nats = nats, .limit = 20.0};
}

SignalStretch law(double onset_s, double end_s) {
  SignalStretch out = drive(onset_s, end_s);
  out.pair = SignalPair::control_law;
  out.joint = 2;
  return out;
}

TEST(SignalStretch, AShareThatIsMissingIsALossWhereAnOffsetExplainsLess) {
  SignalStretch lost = drive(3.0, kNeverEnds);
  lost.loss = 0.4;
  lost.loss_explains = 0.9;
  lost.offset_explains = 0.5;
  EXPECT_EQ(judge_stretch(lost, nullptr).label(), (FaultLabel{FaultKind::torque_loss, 1}));
  EXPECT_EQ(judge_stretch(lost, nullptr).claim.size[0], 0.4);
  lost.offset_explains = 0.85;
  EXPECT_EQ(judge_stretch(lost, nullptr).label(), (FaultLabel{FaultKind::unknown, 1}));
  lost.loss = 0.95;
  lost.offset_explains = 0.0;
  EXPECT_EQ(judge_stretch(lost, nullptr).label(), (FaultLabel{FaultKind::free_swinging, 1}));
}

TEST(SignalStretch, TheTorqueBalanceAddsItsEvidenceForALoss) {
  SignalStretch lost = drive(4.0, kNeverEnds);
  lost.loss = 0.3;
  lost.loss_explains = 0.45;
  const LogFit loses = fit_of(with_loss(healthy(41), 1, 0.3, 4.0)), is_healthy = fit_of(healthy(41));
  const ExplainedFault both = judge_stretch(lost, &loses), alone = judge_stretch(lost, &is_healthy);
  EXPECT_EQ(both.label(), (FaultLabel{FaultKind::torque_loss, 1}));
  EXPECT_GT(both.evidence, 0.45 * lost.nats + 100.0);
  EXPECT_EQ(alone.label(), (FaultLabel{FaultKind::unknown, 1}));
  EXPECT_EQ(alone.evidence, lost.nats) << "the torque balance shows nothing";
}

TEST(SignalStretch, ALossLastsWhereTheTorqueBalanceShowsItAfterTheSignalsEnd) {
  SignalStretch lost = drive(4.0, 5.0);
  lost.loss = 0.3;
  lost.loss_explains = 0.9;
  const LogFit lasts = fit_of(with_loss(healthy(46), 1, 0.3, 4.0)),
               ends = fit_of(with_loss(healthy(46), 1, 0.3, 4.0, 5.0));
  EXPECT_EQ(judge_stretch(lost, &lasts).claim.end_s, kNeverEnds);
  EXPECT_EQ(judge_stretch(lost, &ends).claim.end_s, 5.0);
  EXPECT_NEAR(judge_stretch(lost, &ends).claim.size[0], 0.3, 0.05);
}

TEST(SignalStretch, ASensorThatIsOffShowsInTheBalanceOfWhatItMeasures) {
  SignalStretch off = drive(4.0, kNeverEnds);
  off.offset_explains = 0.95;
  off.balance_is_of_command = false;
  const LogFit shows =
                   fit_of(changed(healthy(42), 4.0, kNeverEnds, [](Log&l, int k) { l.tau[0][k] += 6.0; })),
               is_healthy = fit_of(healthy(42));
  EXPECT_EQ(judge_stretch(off, &shows).label(), kSensor1);
  const ExplainedFault of_drive = judge_stretch(off, &is_healthy);
  EXPECT_EQ(of_drive.label(), (FaultLabel{FaultKind::unknown, 1}));
  EXPECT_EQ(of_drive.could_also_be, std::vector{kSensor1});
  off.end_s = 4.2;
  EXPECT_TRUE(judge_stretch(off, &is_healthy).could_also_be.empty()) << "a sensor that is off stays so";
}

TEST(SignalStretch, ALawThatIsLeftForLongAfterAFaultIsTheControllersAnswer) {
  const FaultClaim ended{FaultKind::locked, 1, 2.0, 3.0}, lasts{FaultKind::locked, 1, 2.0};
  const auto left = [](const SignalStretch& stretch, const FaultClaim& fault) {
    return with_laws({}, {stretch}, {fault}, nullptr).size();
  };
  EXPECT_EQ(left(law(4.0, 9.0), ended), 0u);
  EXPECT_EQ(left(law(4.0, 4.5), lasts), 0u);
  EXPECT_EQ(left(law(4.0, 4.5), ended), 1u) << "short, and behind the end of the fault";
  EXPECT_EQ(left(law(1.0, 9.0), lasts), 1u) << "the law was left first";
}

/// Joint 1 is pushed by a torque that nobody asked for, from 4 to 4.3 s.
Log pushed(std::uint64_t seed) {
  return changed(healthy(seed), 4.0, 4.3, [](Log& l, int k) { l.tau[0][k] -= 8.0; });
}

TEST(SignalStretch, WhatTheTorqueBalanceShowsOfADriveIsNoSecondFault) {
  const UniformLog log = on_grid(pushed(43));
  ASSERT_FALSE(explain_faults(log, scara_model(), evidence_limits({})).faults.empty());
  const ExplainedLog out =
      explain_faults(log, scara_model(), evidence_limits({}), {}, {.begin = {drive(4.0, 4.3)}});
  EXPECT_TRUE(out.faults.empty());
  ASSERT_EQ(out.stretches.size(), 1u);
  EXPECT_EQ(out.stretches[0].fault.label(), (FaultLabel{FaultKind::unknown, 1}));
  EXPECT_GT(out.stretches[0].fault.evidence, 1000.0 + 50.0) << "both rows speak for it";
}

TEST(SignalStretch, AFurtherFaultIsFoundBesideADrive) {
  Log log = changed(pushed(44), 6.0, kNeverEnds, [](Log& l, int k) { l.q[1][k] += 0.05; });
  const ExplainedLog out = explain_faults(on_grid(std::move(log)), scara_model(), evidence_limits({}), {},
                                          {.begin = {drive(4.0, 4.3)}});
  ASSERT_EQ(out.faults.size(), 1u);
  EXPECT_EQ(out.faults[0].label(), (FaultLabel{FaultKind::sensor_bias, 2}));
  EXPECT_NEAR(out.faults[0].claim.onset_s, 6.0, 0.02);
}

TEST(SignalStretch, WhatTheTorqueBalanceShowsWhileALawIsLeftHasTheSameCause) {
  const ExplainedLog out = explain_faults(on_grid(pushed(45)), scara_model(), evidence_limits({}), {},
                                          {.begin = {law(3.8, 4.35)}});
  EXPECT_TRUE(out.faults.empty());
  ASSERT_EQ(out.stretches.size(), 1u);
  EXPECT_EQ(out.stretches[0].fault.label(), (FaultLabel{FaultKind::unknown, 2}));
}

TEST(SignalStretch, ALossThatTheDriveMeasuredIsNotInTheBalanceOfWhatItMeasured) {
  SignalStretch lost = drive(3.0, kNeverEnds);
  lost.loss = 0.4;
  lost.loss_explains = 0.9;
  const auto claims = [&] { return balance_claims({{lost, judge_stretch(lost, nullptr)}}).size(); };
  EXPECT_EQ(claims(), 1u);
  lost.balance_is_of_command = false;
  EXPECT_EQ(claims(), 0u);
}

}  // namespace
}  // namespace faultline
