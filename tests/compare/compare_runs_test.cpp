// SPDX-License-Identifier: MIT
#include "lib/compare/compare_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lib/core/error.hpp"
#include "lib/report/html/comparison/comparison_page.hpp"
#include "tests/learn/small_robot.hpp"

namespace faultline {
namespace {

/// The same motion whatever the seed, which is that of the noise.
SimulationSpec fixed_motion(double duration_s, double period_s = 0.01) {
  SimulationSpec spec = small_run(duration_s);
  spec.sample_period_s = period_s;
  spec.control_period_s = 0.002;
  spec.motion.points = {{-0.30}, {0.0}, {-0.12}, {-0.25}, {0.04}};
  spec.motion.move_min_s = spec.motion.move_max_s = 1.3;
  spec.motion.dwell_min_s = spec.motion.dwell_max_s = 0.2;
  spec.record_reference = true;
  return spec;
}

Log run_of(const SimulationSpec& spec, std::uint64_t seed) { return simulate(small_robot(), spec, seed).log; }

Log without_head(const Log& log, double seconds) {
  int first = 0;
  while (log.time[static_cast<std::size_t>(first)] < seconds - 1e-9) ++first;
  return slice(log, first, log.rows());
}

/// A motion without dynamics, at other times in the second run.
Log timed(double duration_s, double stretch, std::uint64_t seed, double fault_from = 1e9) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, 1e-4);
  Log log;
  log.q.resize(2);
  log.q_ref.resize(2);
  for (int i = 0; i * 0.01 <= duration_s; ++i) {
    const double t = i * 0.01, phase = t + stretch * std::sin(0.5 * t);
    log.time.push_back(t);
    for (std::size_t j = 0; j < 2; ++j) {
      const double q = std::sin(0.9 * phase + double(j)) + 0.4 * std::sin(2.3 * phase);
      log.q_ref[j].push_back(q);
      log.q[j].push_back(q + noise(random) + (j == 1 && phase > fault_from ? 0.01 : 0.0));
    }
  }
  return log;
}

RunComparison compared(const Log& a, const Log& b, AlignmentKind align = AlignmentKind::automatic) {
  return compare_runs(run_signals("a.csv", a), run_signals("b.csv", b), align);
}

std::string told(const RunComparison& comparison) { return to_text(comparison, {0}); }

TEST(CompareRuns, RunsOfOneMotionWithDifferentNoiseAreTheSame) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const RunComparison c =
        compared(run_of(fixed_motion(15.0), seed), run_of(fixed_motion(15.0), seed + 100));
    EXPECT_TRUE(c.same()) << told(c);
    EXPECT_EQ(c.alignment.kind, AlignmentKind::time) << c.alignment.why;
    ASSERT_EQ(c.signals.size(), 3u);
    EXPECT_NEAR(c.signals[0].noise, std::sqrt(2.0) * 2e-5, 0.1 * 3e-5) << "positions";
    EXPECT_NEAR(c.signals[1].noise, std::sqrt(2.0) * 1e-3, 0.1 * 1.5e-3) << "velocities";
  }
}

TEST(CompareRuns, AShiftOfAQuarterSecondIsFoundAndCompensated) {
  const Log a = run_of(fixed_motion(15.0), 1), b = without_head(run_of(fixed_motion(15.0), 2), 0.25);
  const RunComparison c = compared(a, b);
  EXPECT_EQ(c.alignment.kind, AlignmentKind::motion);
  EXPECT_FALSE(c.alignment.warped());
  EXPECT_NEAR(c.alignment.shift_s, -0.25, 1e-4);
  EXPECT_TRUE(c.same()) << told(c);
  const RunComparison back = compared(b, a);
  EXPECT_NEAR(back.alignment.shift_s, 0.25, 1e-4);
  EXPECT_TRUE(back.same()) << told(back);
  const RunComparison by_time = compared(a, b, AlignmentKind::time);
  EXPECT_FALSE(by_time.same());
  EXPECT_EQ(by_time.alignment.shift_s, 0.0);
}

TEST(CompareRuns, AShiftIsFoundFromPositionsAlone) {
  Log a = run_of(fixed_motion(15.0), 1), b = without_head(run_of(fixed_motion(15.0), 2), 0.25);
  b.q_ref.clear();
  b.dq_ref.clear();
  const RunComparison c = compared(a, b);
  EXPECT_NEAR(c.alignment.shift_s, -0.25, 5e-4);
  EXPECT_NE(c.alignment.why.find("no references were recorded"), std::string::npos) << c.alignment.why;
  EXPECT_TRUE(c.same()) << told(c);
}

TEST(CompareRuns, TheOnsetOfAFaultIsTheFirstDivergence) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double head : {0.0, 0.25}) {
    SimulationSpec bad = fixed_motion(15.0);
    bad.faults = {{FaultKind::torque_loss, 1_joint, 7.9, infinity, 0.5, 0}};
    const RunComparison c = compared(run_of(fixed_motion(15.0), 1), without_head(run_of(bad, 2), head));
    ASSERT_NE(c.first_divergence(), nullptr) << told(c);
    EXPECT_GE(c.first_divergence()->diverges_s, 7.9 - 0.02) << told(c);
    EXPECT_LE(c.first_divergence()->diverges_s, 8.2) << told(c);
    EXPECT_NEAR(c.alignment.shift_s, -head, 1e-3);
    EXPECT_FALSE(c.same());
    EXPECT_GT(std::abs(c.signals[2].largest), 5.0 * c.signals[2].noise);
  }
}

TEST(CompareRuns, LengthsAndSamplePeriodsMayDiffer) {
  const RunComparison c = compared(run_of(fixed_motion(15.0, 0.01), 1), run_of(fixed_motion(11.0, 0.004), 2));
  EXPECT_NEAR(c.compared_s, 11.0, 0.02);
  EXPECT_TRUE(c.same()) << told(c);
  EXPECT_NE(told(c).find("no counterpart"), std::string::npos) << told(c);
  const RunComparison back =
      compared(run_of(fixed_motion(11.0, 0.004), 2), run_of(fixed_motion(15.0, 0.01), 1));
  EXPECT_TRUE(back.same()) << told(back);
}

TEST(CompareRuns, RunsOfDifferentMotionsAreReportedAsSuch) {
  SimulationSpec other = fixed_motion(15.0);
  other.motion.points = {{0.0}, {-0.2}, {0.05}, {-0.33}};
  const RunComparison c = compared(run_of(fixed_motion(15.0), 1), run_of(other, 2));
  EXPECT_FALSE(c.alignment.same_motion) << c.alignment.why;
  EXPECT_FALSE(c.same());
  EXPECT_NE(verdict_of(c).find("different motions"), std::string::npos);
}

TEST(CompareRuns, ASevereFaultWithoutReferencesIsNotADifferentMotion) {
  SimulationSpec good = fixed_motion(15.0), bad = good;
  good.record_reference = bad.record_reference = false;
  bad.faults = {{FaultKind::free_swinging, 1_joint, 7.9, std::numeric_limits<double>::infinity(), 0, 0}};
  for (const double head : {0.0, 0.25}) {
    const RunComparison c = compared(run_of(good, 1), without_head(run_of(bad, 2), head));
    EXPECT_TRUE(c.alignment.same_motion) << told(c);
    EXPECT_FALSE(c.alignment.warped());
    EXPECT_NEAR(c.alignment.shift_s, -head, 1e-3);
    ASSERT_NE(c.first_divergence(), nullptr) << told(c);
    EXPECT_NEAR(c.first_divergence()->diverges_s, 7.95, 0.1) << told(c);
  }
}

TEST(CompareRuns, OnlyResidualsOfDifferentMotionsAreJudged) {
  RunSignals a = run_signals("a", timed(20.0, 0.0, 1)), b = run_signals("b", timed(20.0, 9.0, 2));
  EXPECT_EQ(compare_runs(a, b).first_divergence(), nullptr);
  std::mt19937_64 random(4);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (RunSignals* run : {&a, &b}) {
    RunSignal residual{"residual", 1_joint, a.signals[0].time, {}};
    for (const double t : residual.time)
      residual.values.push_back(noise(random) + (run == &b && t > 7.9 ? 20.0 : 0.0));
    run->signals.push_back(residual);
  }
  const RunComparison c = compare_runs(a, b);
  ASSERT_FALSE(c.alignment.same_motion) << told(c);
  ASSERT_NE(c.first_divergence(), nullptr);
  EXPECT_NEAR(c.first_divergence()->diverges_s, 7.9, 0.05);
  EXPECT_NE(verdict_of(c).find("their residuals differ from 7.9"), std::string::npos) << verdict_of(c);
}

TEST(CompareRuns, MovesOfDifferentDurationAreAlignedByAWarp) {
  const RunComparison c = compared(timed(20.0, 0.0, 1), timed(20.0, 0.3, 2));
  ASSERT_TRUE(c.alignment.warped()) << c.alignment.why;
  EXPECT_LT(c.alignment.left_rms, 0.01) << c.alignment.why;
  for (std::size_t i = 1; i < c.alignment.first_s.size(); ++i) {
    EXPECT_GT(c.alignment.first_s[i], c.alignment.first_s[i - 1]);
    EXPECT_GT(c.alignment.second_s[i], c.alignment.second_s[i - 1]);
  }
  EXPECT_TRUE(c.same()) << told(c);
  const RunComparison bad = compared(timed(20.0, 0.0, 1), timed(20.0, 0.3, 2, 7.9));
  ASSERT_NE(bad.first_divergence(), nullptr);
  EXPECT_NEAR(bad.first_divergence()->diverges_s, 7.9, 0.05) << told(bad);
  EXPECT_EQ(bad.first_divergence()->joint, 2_joint);
}

TEST(CompareRuns, OneOutlierIsNotADivergence) {
  Log b = run_of(fixed_motion(15.0), 2);
  b.q[0][500] += 0.1;
  const RunComparison c = compared(run_of(fixed_motion(15.0), 1), b);
  EXPECT_TRUE(c.same()) << told(c);
  EXPECT_NEAR(c.signals[0].largest, 0.1, 1e-3);
  EXPECT_NEAR(c.signals[0].largest_s, 5.0, 1e-6);
}

TEST(CompareRuns, ARunDoesNotDifferFromItself) {
  const Log a = run_of(fixed_motion(5.0), 1);
  const RunComparison c = compared(a, a);
  EXPECT_TRUE(c.same());
  for (const SignalDifference& signal : c.signals) EXPECT_EQ(signal.rms, 0.0);
}

TEST(CompareRuns, AnotherNumberOfJointsAndTooFewRowsAreRefused) {
  EXPECT_THROW(compared(timed(5.0, 0.0, 1), run_of(fixed_motion(5.0), 1)), Error);
  EXPECT_THROW(run_signals("a", slice(timed(5.0, 0.0, 1), 0, 5)), Error);
}

TEST(ComparisonPage, ShowsTheVerdictAndEveryJointWithoutScript) {
  const RunComparison c = compared(timed(20.0, 0.0, 1), timed(20.0, 0.3, 2, 7.9));
  const std::string page = render_comparison_html(c, {});
  EXPECT_NE(page.find("The runs differ from 7.9"), std::string::npos);
  for (const char* part : {"Position of joint 1", "Position of joint 2, close up", "minus time of the first"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page, render_comparison_html(c, {}));
}

}  // namespace
}  // namespace faultline
