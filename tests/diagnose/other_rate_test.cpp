// SPDX-License-Identifier: MIT
// Logs whose sample period is not that of the logs that a model was learned from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "lib/diagnose/curves/run_curves.hpp"
#include "lib/diagnose/diagnose.hpp"
#include "lib/diagnose/monitor/model_rate.hpp"
#include "lib/report/text.hpp"
#include "tests/learn/small_robot.hpp"

namespace faultline {
namespace {

constexpr double kOnset_s = 3.004;

/// Learned once from runs of the slide at 100 Hz.
const Learned& learned_at_100_hz() {
  static const Learned learned = learn_small();
  return learned;
}

Log slide_at(double period_s, FaultKind kind = FaultKind::none, std::uint64_t seed = 41) {
  SimulationSpec spec = small_run(7.0);
  spec.sample_period_s = spec.control_period_s = period_s;
  if (kind != FaultKind::none)
    spec.faults = {{kind, 1_joint, kOnset_s, std::numeric_limits<double>::infinity(), 0.8, 0.0}};
  return simulate(small_robot(), spec, seed).log;
}

Diagnosis diagnosed_at(const Log& log, int segment_rows = 4096) {
  MemorySource source(log, "run.csv", segment_rows);
  return diagnose(source, learned_at_100_hz().model, learned_at_100_hz().cases);
}

/// Whether a fault is called so, or may be so.
bool is_named(const FaultFinding& fault, FaultKind kind) {
  return fault.label.kind == kind || std::any_of(fault.could_also_be.begin(), fault.could_also_be.end(),
                                                 [&](const auto& other) { return other.label.kind == kind; });
}

TEST(OtherRate, HealthyLogsAtOtherRatesAreHealthyAndReportedAsResampled) {
  for (const double period_s : {0.002, 0.004, 0.008, 0.0095, 0.0125})
    for (const std::uint64_t seed : {41, 42, 43}) {
      const Diagnosis diagnosis = diagnosed_at(slide_at(period_s, FaultKind::none, seed));
      EXPECT_EQ(diagnosis.verdict, Verdict::healthy) << period_s << ": " << diagnosis.verdict_reason;
      ASSERT_NE(diagnosis.log.issues.find(kResampled), nullptr) << period_s;
      EXPECT_EQ(diagnosis.log.issues.find(kResampled)->severity, Severity::warning);
    }
  for (const double period_s : {0.0099, 0.0101}) {
    const Diagnosis diagnosis = diagnosed_at(slide_at(period_s));
    EXPECT_EQ(diagnosis.log.issues.find(kResampled), nullptr) << "one percent is the same rate: " << period_s;
    EXPECT_EQ(diagnosis.verdict, Verdict::healthy);
  }
}

TEST(OtherRate, AFaultIsFoundAtItsTimeOnTheClockOfTheLog) {
  for (const double period_s : {0.004, 0.008, 0.0125}) {
    Log log = slide_at(period_s, FaultKind::locked);
    for (double& t : log.time) t += 1000.0;
    const Diagnosis diagnosis = diagnosed_at(log);
    ASSERT_EQ(diagnosis.faults.size(), 1u) << period_s;
    EXPECT_TRUE(is_named(diagnosis.faults[0], FaultKind::locked)) << period_s;
    EXPECT_NEAR(diagnosis.faults[0].onset_s, 1000.0 + kOnset_s, 0.15) << period_s;
  }
  const Log log = slide_at(0.004, FaultKind::free_swinging);
  const std::string whole = render_json(diagnosed_at(log));
  for (const int rows : {1, 7, 64})
    EXPECT_EQ(whole, render_json(diagnosed_at(log, rows))) << "borders of segments: " << rows;
}

TEST(OtherRate, CurvesOfAReportShowTheJudgedRows) {
  const Model& model = learned_at_100_hz().model;
  const Log log = slide_at(0.002);
  MemorySource source(log, "run.csv");
  const Diagnosis diagnosis = diagnose(source, model, learned_at_100_hz().cases);
  std::unique_ptr<LogSource> kept;
  const Log judged = read_all(judged_rows(source, model, diagnosis.log.issues, kept));
  ASSERT_EQ(judged.rows(), 701);
  EXPECT_NEAR(judged.time[1], 0.01, 1e-12);
  EXPECT_NEAR(judged.q[0][1], log.q[0][5], 1e-9);

  EXPECT_NEAR(diagnosis.log.sample_period_s, 0.002, 1e-9) << "of the log as it was recorded";
  const RunCurves curves = run_curves(source, model, diagnosis);
  ASSERT_GT(curves.whole.bins, 100);
  for (const float q : curves.whole.joints[0].q.values)
    EXPECT_TRUE(std::isfinite(q)) << "a bin without a row";
}

TEST(OtherRate, TheInterpretationIsCheckedAfterTheRate) {
  for (const FaultKind kind : {FaultKind::none, FaultKind::locked}) {
    const Diagnosis slow = diagnosed_at(slide_at(0.1, kind));
    EXPECT_EQ(slow.verdict, Verdict::inconclusive);
    EXPECT_TRUE(slow.faults.empty());
    EXPECT_NE(slow.verdict_reason.find("has a sample every 0.1 s"), std::string::npos) << slow.verdict_reason;
    EXPECT_EQ(slow.log.issues.find(kMisreadLog), nullptr) << "a slow log is no other robot's";
  }
  Log log = slide_at(0.01);
  for (double& t : log.time) t *= 1000.0;
  EXPECT_NE(diagnosed_at(log).verdict_reason.find("the time is in milliseconds"), std::string::npos);

  Learned doubtful = learned_at_100_hz();
  doubtful.model.identification.status = IdentificationStatus::unexplained;
  log = slide_at(0.01);
  for (double& torque : log.tau[0]) torque = -torque;
  EXPECT_NE(diagnosed_at(log).log.issues.find(kMisreadLog), nullptr);
  MemorySource source(log, "run.csv");
  EXPECT_EQ(diagnose(source, doubtful.model, doubtful.cases).log.issues.find(kMisreadLog), nullptr)
      << "a robot that did not explain its own logs contradicts no other";
}

TEST(OtherRate, ALogAtAFarTooCoarseRateIsReadButNotJudged) {
  const Diagnosis slow = diagnosed_at(slide_at(0.02, FaultKind::torque_loss));
  EXPECT_EQ(slow.verdict, Verdict::inconclusive);
  EXPECT_NE(slow.verdict_reason.find("a sample every 0.02 s"), std::string::npos) << slow.verdict_reason;
  EXPECT_TRUE(slow.residuals.empty()) << "nothing of it was held against the robot";
  EXPECT_TRUE(slow.faults.empty());
  EXPECT_GT(slow.log.rows_used, 0);
}

}  // namespace
}  // namespace faultline
