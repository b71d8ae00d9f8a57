// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/explain_monitor.hpp"

#include <gtest/gtest.h>

#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

Model model() {
  Model out;
  out.robot = preset_robot("RRP");
  out.sample_period_s = testing::kExplainedPeriod_s;
  out.motion.torque_scale = {20.0, 10.0, 40.0};
  out.explain = {testing::scara_model(), evidence_limits({})};
  return out;
}

/// Several days one after the other, each begins `gap_s` after the one before.
Log days(int count, double gap_s) {
  Log out;
  for (int day = 0; day < count; ++day) {
    Log next = testing::simulate_closed_form(testing::of_day(1), testing::run_of(31 + day));
    const double later_s = day > 0 ? out.time.back() + gap_s - next.time.front() : 0.0;
    for (double& t : next.time) t += later_s;
    out.rows() == 0 ? void(out = next) : append(out, next);
  }
  return out;
}

/// Joint 2 gets 70 % of its torque.
void lose_torque(Log& log, double from_s, double until_s = kNeverEnds) {
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= from_s && log.time[k] < until_s) log.tau[1][k] /= 0.7;
}

ExplainMonitor monitored(const Model& model, const Log& log, int segment_rows,
                         std::vector<SignalStretch> signals = {}) {
  ExplainMonitor monitor(model, std::move(signals));
  for (int begin = 0; begin < log.rows(); begin += segment_rows)
    monitor.take(slice(log, begin, std::min(log.rows(), begin + segment_rows)), {}, {});
  monitor.finish();
  return monitor;
}

TEST(ExplainMonitor, BordersOfSegmentsChangeNothing) {
  const Model m = model();
  Log log = days(1, 0.0);
  lose_torque(log, 4.0);
  const ExplainMonitor whole = monitored(m, log, 1 << 20), pieces = monitored(m, log, 37);
  ASSERT_EQ(whole.episodes().size(), 1u);
  ASSERT_EQ(pieces.episodes().size(), 1u);
  EXPECT_EQ(whole.episodes()[0].fault.label(), (FaultLabel{FaultKind::torque_loss, 2_joint}));
  EXPECT_EQ(whole.episodes()[0].onset_s(), pieces.episodes()[0].onset_s());
  EXPECT_EQ(whole.episodes()[0].fault.evidence, pieces.episodes()[0].fault.evidence);
  EXPECT_EQ(whole.day()[0].value, pieces.day()[0].value);
}

TEST(ExplainMonitor, AGapEndsAWindowAndBothPartsAreJudged) {
  const Model m = model();
  Log log = days(2, 60.0);
  lose_torque(log, log.time.back() - 4.0);
  const ExplainMonitor judged = monitored(m, log, 500);
  ASSERT_EQ(judged.episodes().size(), 1u);
  EXPECT_NEAR(judged.episodes()[0].onset_s(), log.time.back() - 4.0, 0.05);
}

TEST(ExplainMonitor, ALogWithACutUnderClosedTimeStampsHasNoFault) {
  const Model m = model();
  const Log log = days(1, 0.0);
  const int from = log.rows() / 2, to = from + static_cast<int>(1.3 / m.sample_period_s);
  ASSERT_GT(std::abs(log.q[0][to] - log.q[0][from]), 0.1);
  ASSERT_GT(std::abs(log.q[1][to] - log.q[1][from]), 0.1);
  Log cut = slice(log, 0, from), rest = slice(log, to, log.rows());
  for (double& t : rest.time) t -= log.time[to] - log.time[from] - 7.0 * m.sample_period_s;
  append(cut, rest);
  EXPECT_TRUE(monitored(m, cut, 4096).episodes().empty());
}

Log long_log(std::uint64_t seed, double duration_s) {
  testing::ClosedFormRun run = testing::run_of(seed);
  run.duration_s = duration_s;
  return testing::simulate_closed_form(testing::of_day(1), run);
}

TEST(ExplainMonitor, AFaultAtTheBorderOfTwoWindowsIsOneFault) {
  const Model m = model();
  Log log = long_log(35, 100.0);
  lose_torque(log, 56.0);
  const ExplainMonitor judged = monitored(m, log, 4096);
  ASSERT_EQ(judged.episodes().size(), 1u);
  EXPECT_EQ(judged.episodes()[0].fault.label(), (FaultLabel{FaultKind::torque_loss, 2_joint}));
  EXPECT_NEAR(judged.episodes()[0].onset_s(), 56.0, 0.1);
  EXPECT_NEAR(judged.episodes()[0].end_s, log.time.back(), 1e-9);
}

TEST(ExplainMonitor, AFaultThatLastsForSeveralWindowsIsOneFaultWithItsEnd) {
  const Model m = model();
  Log log = long_log(36, 190.0);
  lose_torque(log, 20.0, 151.0);
  const ExplainMonitor judged = monitored(m, log, 4096);
  ASSERT_EQ(judged.episodes().size(), 1u);
  EXPECT_EQ(judged.episodes()[0].fault.label(), (FaultLabel{FaultKind::torque_loss, 2_joint}));
  EXPECT_NEAR(judged.episodes()[0].onset_s(), 20.0, 0.1);
  EXPECT_NEAR(judged.episodes()[0].end_s, 151.0, 0.2);
}

TEST(ExplainMonitor, AFurtherFaultIsFoundDuringALastingFault) {
  const Model m = model();
  Log log = long_log(37, 150.0);
  lose_torque(log, 20.0);
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= 120.0) log.q[2][k] += 0.01;
  const ExplainMonitor judged = monitored(m, log, 4096);
  ASSERT_EQ(judged.episodes().size(), 2u);
  EXPECT_EQ(judged.episodes()[0].fault.label(), (FaultLabel{FaultKind::torque_loss, 2_joint}));
  EXPECT_NEAR(judged.episodes()[0].end_s, log.time.back(), 1e-9);
  EXPECT_EQ(judged.episodes()[1].fault.label().joint, 3_joint);
  EXPECT_NEAR(judged.episodes()[1].onset_s(), 120.0, 0.1);
}

TEST(ExplainMonitor, TheScoreOfALongLogIsThatOfItsWindowNearestToAnAlarm) {
  const Model m = model();
  Log log = long_log(38, 150.0);
  const EvidenceScore healthy = monitored(m, log, 4096).score();
  EXPECT_TRUE(healthy.is_known());
  EXPECT_LT(healthy.ratio(), 1.0);
  lose_torque(log, 120.0, 121.0);
  const ExplainMonitor judged = monitored(m, log, 4096);
  ASSERT_EQ(judged.episodes().size(), 1u);
  EXPECT_GT(judged.score().ratio(), 1.0);
  EXPECT_NEAR(judged.score().onset_s, 120.0, 1.0);
}

SignalStretch stretch(SignalPair pair, double onset_s, double end_s) {
  return {
      .pair = pair, .joint = 1_joint, .onset_s = onset_s, .alarm_s = onset_s, .end_s = end_s, .nats = 500.0};
}

TEST(ExplainMonitor, AStretchInTheOverlapOfTwoWindowsIsOneFault) {
  const Model m = model();
  const Log log = long_log(39, 100.0);
  for (const double onset_s : {45.0, 52.0, 58.0}) {
    const ExplainMonitor judged =
        monitored(m, log, 4096, {stretch(SignalPair::drive, onset_s, onset_s + 0.3)});
    ASSERT_EQ(judged.stretches().size(), 1u) << onset_s;
    EXPECT_EQ(judged.stretches()[0].fault.claim.onset_s, onset_s);
    EXPECT_TRUE(judged.episodes().empty());
  }
}

TEST(ExplainMonitor, ALongDeviationFromTheLawIsAResponseToAFaultOfAnEarlierWindow) {
  const Model m = model();
  Log log = long_log(40, 150.0);
  lose_torque(log, 20.0, 25.0);
  const SignalStretch left = stretch(SignalPair::control_law, 120.0, kNeverEnds);
  EXPECT_TRUE(monitored(m, log, 4096, {left}).stretches().empty());
  EXPECT_EQ(monitored(m, long_log(40, 150.0), 4096, {left}).stretches().size(), 1u);
}

TEST(ExplainMonitor, AStretchOfALogThatIsTooShortForATorqueBalanceIsAFault) {
  const ExplainMonitor judged =
      monitored(model(), slice(days(1, 0.0), 0, 100), 50, {stretch(SignalPair::drive, 0.1, 0.3)});
  EXPECT_EQ(judged.stretches().size(), 1u);
}

TEST(ExplainMonitor, AnEncoderThatIsStuckForSeveralWindowsIsOneFaultWithItsEnd) {
  const Model m = model();
  Log log = long_log(38, 150.0);
  const auto first = static_cast<std::size_t>(20.0 / m.sample_period_s);
  for (std::size_t k = first; k < static_cast<std::size_t>(110.0 / m.sample_period_s); ++k) {
    log.q[1][k] = log.q[1][first];
    log.dq[1][k] = 0.0;
  }
  const ExplainMonitor judged = monitored(m, log, 4096);
  ASSERT_EQ(judged.episodes().size(), 1u);
  EXPECT_EQ(judged.episodes()[0].fault.label(), (FaultLabel{FaultKind::stuck_encoder, 2_joint}));
  EXPECT_NEAR(judged.episodes()[0].onset_s(), 20.0, 0.1);
  EXPECT_NEAR(judged.episodes()[0].end_s, 110.0, 0.1);
}

TEST(ExplainMonitor, AVeryShortLogIsNotJudged) {
  const Model m = model();
  const ExplainMonitor judged = monitored(m, slice(days(1, 0.0), 0, 100), 50);
  EXPECT_TRUE(judged.episodes().empty());
  EXPECT_TRUE(judged.day().empty());
}

TEST(ExplainMonitor, NormalRangeOfADayIsAtLeastTheStatedRange) {
  Model m = model();
  m.robot.normal.friction = 0.3;
  const ExplainMonitor judged = monitored(m, days(1, 0.0), 4096);
  ASSERT_FALSE(judged.day().empty());
  EXPECT_EQ(judged.day()[0].kind, DayEffectKind::friction);
  EXPECT_GE(judged.day()[0].normal_range(), 0.3 - 1e-12);
}

}  // namespace
}  // namespace faultline
