// SPDX-License-Identifier: MIT
#include "lib/diagnose/curves/run_curves.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "lib/diagnose/diagnose.hpp"
#include "lib/report/html/html_report.hpp"
#include "tests/learn/small_robot.hpp"

namespace faultline {
namespace {

constexpr double kOnset_s = 3.004;

const Learned& learned() {
  static const Learned value = learn_small();
  return value;
}

Log free_swinging_run() {
  SimulationSpec spec = small_run(7.0);
  spec.faults = {
      {FaultKind::free_swinging, 1_joint, kOnset_s, std::numeric_limits<double>::infinity(), 0.0, 0.0}};
  return simulate(small_robot(), spec, 31).log;
}

float largest(const std::vector<float>& values) {
  float most = -std::numeric_limits<float>::infinity();
  for (const float value : values) most = std::fmax(most, value);
  return most;
}

TEST(RunCurves, SegmentBordersChangeNoByteOfThePage) {
  const Log log = free_swinging_run();
  auto page = [&](int segment_rows) {
    MemorySource source(log, "run.csv", segment_rows);
    const Diagnosis d = diagnose(source, learned().model, learned().cases);
    return render_html(d, report_details(source, learned().model, d));
  };
  const std::string whole = page(1 << 20);
  EXPECT_NE(whole.find("plot-1-q1"), std::string::npos);
  for (const int rows : {1, 7, 64}) EXPECT_TRUE(whole == page(rows)) << rows;
}

void no_peak_is_lost_however_few_the_bins() {
  Log log = simulate(small_robot(), small_run(7.0), 33).log;
  log.tau[0][123] = 777.0;
  log.q[0][456] = -55.0;
  MemorySource source(log, "run.csv");
  const Diagnosis d = diagnose(source, learned().model, learned().cases);
  const RunCurves curves = run_curves(source, learned().model, d, {.whole_bins = 5});
  ASSERT_EQ(curves.whole.bins, 5);
  const JointCurves& joint = curves.whole.joints.at(0);
  ASSERT_EQ(joint.tau.values.size(), 10u);
  EXPECT_EQ(largest(joint.tau.values), 777.0f);
  EXPECT_EQ(*std::min_element(joint.q.values.begin(), joint.q.values.end()), -55.0f);
}

void detail_lies_around_the_fault_and_holds_both_networks() {
  MemorySource source(free_swinging_run(), "run.csv");
  const Diagnosis d = diagnose(source, learned().model, learned().cases);
  ASSERT_EQ(d.faults.size(), 1u);
  const RunCurves curves = run_curves(source, learned().model, d);
  ASSERT_EQ(curves.details.size(), 1u);
  const CurveWindow& detail = curves.details[0];
  EXPECT_LT(detail.start_s, kOnset_s - 1.0);
  EXPECT_GT(detail.end_s, d.faults[0].alarm_s + 2.0);
  ASSERT_GE(detail.networks.size(), 2u);
  EXPECT_EQ(detail.networks.back().label.kind, FaultKind::none);
  const std::vector<float>& fault_free = detail.networks.back().mlp.values;
  EXPECT_GT(largest(fault_free), 0.5f);
  EXPECT_GT(largest(detail.joints[0].residual), curves.healthy_residual.at(0));
}

void what_is_predicted_is_near_what_is_measured_when_healthy() {
  MemorySource source(simulate(small_robot(), small_run(7.0), 33).log, "run.csv");
  const Diagnosis d = diagnose(source, learned().model, learned().cases);
  ASSERT_EQ(d.verdict, Verdict::healthy);
  const JointCurves joint = run_curves(source, learned().model, d).whole.joints.at(0);
  ASSERT_EQ(joint.q.values.size(), joint.q_predicted.values.size());
  int compared = 0;
  for (std::size_t i = 2; i < joint.q.values.size(); ++i) {
    if (!std::isfinite(joint.q_predicted.values[i])) continue;
    ++compared;
    EXPECT_NEAR(joint.q.values[i], joint.q_predicted.values[i], 0.01) << i;
  }
  EXPECT_GT(compared, 500);
}

/// Root mean square of the differences of both curves over that of the first, both in the middle of each bin.
double off_by(const Envelope& shown, const Envelope& expected) {
  double difference = 0.0, square = 0.0;
  EXPECT_EQ(shown.values.size(), expected.values.size());
  for (std::size_t i = 0; i + 1 < shown.values.size(); i += 2) {
    const double a = 0.5 * (shown.values[i] + shown.values[i + 1]),
                 b = 0.5 * (expected.values[i] + expected.values[i + 1]);
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    difference += (a - b) * (a - b);
    square += b * b;
  }
  return std::sqrt(difference / square);
}

void torque_needed_by_the_healthy_robot_is_the_command_while_it_is_healthy() {
  MemorySource source(simulate(small_robot(), small_run(7.0), 33).log, "run.csv");
  const Diagnosis d = diagnose(source, learned().model, learned().cases);
  ASSERT_EQ(d.verdict, Verdict::healthy);
  const JointCurves joint = run_curves(source, learned().model, d).whole.joints.at(0);
  EXPECT_LT(off_by(joint.tau_required, joint.tau), 0.02);
}

void log_without_a_span_of_time_gives_none() {
  MemorySource source(slice(free_swinging_run(), 0, 1), "run.csv");
  const Diagnosis d = diagnose(source, learned().model, learned().cases);
  EXPECT_TRUE(run_curves(source, learned().model, d).empty());
  EXPECT_EQ(render_html(d, report_details(source, learned().model, d)).find("<script"), std::string::npos);
}

void evidence_grows_from_the_onset_past_the_threshold() {
  MemorySource source(free_swinging_run(), "run.csv");
  const Diagnosis d = diagnose(source, learned().model, learned().cases);
  const EvidenceTrace& trace = d.faults.at(0).trace;
  ASSERT_FALSE(trace.curves.empty());
  EXPECT_LE(trace.time.size(), 130u);
  const std::vector<double>& best = trace.curves[0].ratio;
  ASSERT_EQ(best.size(), trace.time.size());
  EXPECT_GT(best.back(), trace.limit) << "the trace goes on beyond the alarm";
  const auto first = std::ranges::find_if(best, [](double ratio) { return std::isfinite(ratio); });
  EXPECT_GE(trace.time[static_cast<std::size_t>(first - best.begin())], kOnset_s - 0.5)
      << "other hypotheses may begin earlier";
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (!(trace.time[i] < kOnset_s - 0.02 && std::isfinite(best[i]))) continue;
    EXPECT_LT(best[i], trace.limit);
  }
}

// Learning takes seconds, so these share one model in one process.
TEST(RunCurves, ShowMotionTorqueAndEvidenceOfTheRun) {
  no_peak_is_lost_however_few_the_bins();
  what_is_predicted_is_near_what_is_measured_when_healthy();
  torque_needed_by_the_healthy_robot_is_the_command_while_it_is_healthy();
  log_without_a_span_of_time_gives_none();
  detail_lies_around_the_fault_and_holds_both_networks();
  evidence_grows_from_the_onset_past_the_threshold();
}

TEST(ModelFile, KeepsTheIntervalsOfTheParameters) {
  const Model read = model_from_json(model_to_json(learned().model), "model");
  ASSERT_FALSE(read.identification.base_parameters.empty());
  EXPECT_EQ(read.identification.base_parameters[0].ci95, learned().identification.base_parameters[0].ci95);
}

}  // namespace
}  // namespace faultline
