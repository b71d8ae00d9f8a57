// SPDX-License-Identifier: MIT
#include "lib/simulate/recording.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "lib/core/error.hpp"
#include "tests/simulate/short_runs.hpp"

namespace faultline {
namespace {

constexpr double kPeriod_s = 0.01;
constexpr int kRows = 20001;

/// One joint whose values tell the row.
Log exact_log() {
  Log log;
  log.q.resize(1);
  log.dq = log.tau = log.q;
  for (int k = 0; k < kRows; ++k) {
    log.time.push_back(k * kPeriod_s);
    log.q[0].push_back(1e-3 * k * k);
    log.dq[0].push_back(-7.0);
    log.tau[0].push_back(k);
  }
  return log;
}

Log recorded_as(const RecordingSpec& spec, std::uint64_t seed = 1) {
  return recorded(exact_log(), spec, kPeriod_s, Random(seed));
}

void expect_ascending(const std::vector<double>& time) {
  EXPECT_GE(time.front(), 0.0);
  for (std::size_t k = 1; k < time.size(); ++k) ASSERT_GT(time[k], time[k - 1]) << k;
}

TEST(Recording, IsExactByDefault) {
  const Log log = recorded_as({}), exact = exact_log();
  EXPECT_EQ(log.time, exact.time);
  EXPECT_EQ(log.q, exact.q);
  EXPECT_EQ(log.dq, exact.dq);
  EXPECT_EQ(log.tau, exact.tau);
}

TEST(Recording, JitterAffectsTimeStampsButNotMeasurements) {
  const Log log = recorded_as({.jitter_s = 0.001});
  expect_ascending(log.time);
  double square = 0.0;
  for (int k = 1; k < kRows; ++k) square += std::pow(log.time[k] - k * kPeriod_s, 2) / kRows;
  EXPECT_NEAR(std::sqrt(square), 0.001, 3e-5);
  EXPECT_EQ(log.q, exact_log().q);
}

TEST(Recording, TimeStampsAscendDespiteJitter) {
  expect_ascending(recorded_as({.jitter_s = 0.03}).time);
  expect_ascending(recorded_as({.jitter_s = 0.03, .stamp_resolution_s = 0.004}).time);
  expect_ascending(recorded_as({.jitter_s = 0.03, .stamp_resolution_s = kPeriod_s}).time);
}

TEST(Recording, TimeStampsAreRounded) {
  const Log log = recorded_as({.stamp_resolution_s = 0.004});
  expect_ascending(log.time);
  for (int k = 0; k < kRows; ++k) {
    ASSERT_LE(std::abs(log.time[k] - k * kPeriod_s), 0.002 + 1e-9);
    ASSERT_NEAR(log.time[k] / 0.004, std::round(log.time[k] / 0.004), 1e-6);
  }
  EXPECT_EQ(log.time[1], 0.012) << "as decimal as the resolution";
}

TEST(Recording, RowsAreLostByTheirShare) {
  const Log log = recorded_as({.lost = 0.1});
  EXPECT_NEAR(log.rows(), 0.9 * kRows, 4.0 * std::sqrt(0.09 * kRows));
  EXPECT_EQ(log.time.front(), 0.0);
  EXPECT_EQ(log.tau[0].back(), kRows - 1);
  for (int k = 0; k < log.rows(); ++k) ASSERT_EQ(log.time[k], log.tau[0][k] * kPeriod_s) << "whole rows";
}

TEST(Recording, JitterDoesNotChangeWhichRowsAreLost) {
  EXPECT_EQ(recorded_as({.lost = 0.1}).tau, recorded_as({.jitter_s = 0.001, .lost = 0.1}).tau);
  EXPECT_NE(recorded_as({.lost = 0.1}).tau, recorded_as({.lost = 0.1}, 2).tau);
}

TEST(Recording, TorqueIsLateByWholeRows) {
  const Log log = recorded_as({.torque_late_rows = 3});
  for (int k = 0; k < kRows; ++k) ASSERT_EQ(log.tau[0][k], std::max(k - 3, 0));
  EXPECT_EQ(log.q, exact_log().q);
}

TEST(Recording, TorqueIsRounded) {
  const Log log = recorded_as({.torque_resolution = {0.3}});
  EXPECT_NEAR(log.tau[0][1], 0.9, 1e-12);
  for (const double tau : log.tau[0]) ASSERT_NEAR(tau / 0.3, std::round(tau / 0.3), 1e-6);
}

TEST(Recording, VelocityIsTheDifferenceOfPositions) {
  const Log log = recorded_as({.lost = 0.2, .velocity = RecordedVelocity::difference});
  EXPECT_EQ(log.dq[0][0], -7.0) << "the first row has no row before it";
  for (int k = 1; k < log.rows(); ++k) {
    const double row = log.tau[0][k];
    ASSERT_NEAR(log.dq[0][k], 1e-3 * (2.0 * row - 1.0) / kPeriod_s, 1e-6) << "also behind a row that is lost";
  }
}

TEST(Recording, AFilteredVelocityIsLateByItsTimeConstant) {
  Log ramp = exact_log();
  for (int k = 0; k < ramp.rows(); ++k) ramp.dq[0][k] = 2.0 * k * kPeriod_s;
  const double late_s = 4.0 * kPeriod_s;
  const Log log = recorded(ramp, {.velocity_filter_s = late_s}, kPeriod_s, Random(1));
  // Of inputs held between rows: 1 / (exp(period / late) - 1) rows.
  const double rows = 1.0 / (std::exp(kPeriod_s / late_s) - 1.0);
  EXPECT_NEAR(log.dq[0].back(), 2.0 * (ramp.rows() - 1 - rows) * kPeriod_s, 1e-9);
}

TEST(Recording, DoesNotChangeTheTruthOfARun) {
  SimulationSpec spec = with_fault(FaultKind::torque_loss, 1_joint, 1.0, 0.5);
  spec.noise.q_resolution = {1e-4, 1e-4, 1e-5};
  const SimulatedRun exact = simulate(industrial(), spec, 3);
  spec.recording = {.jitter_s = 1e-4, .lost = 0.05, .velocity = RecordedVelocity::difference};
  const SimulatedRun run = simulate(industrial(), spec, 3);
  ASSERT_EQ(run.truth.size(), 1u);
  EXPECT_EQ(run.truth[0].onset_s, 1.0);
  EXPECT_EQ(run.truth[0].end_s, exact.truth[0].end_s);
  const std::set<double> positions(exact.log.q[0].begin(), exact.log.q[0].end());
  for (const double q : run.log.q[0]) ASSERT_EQ(positions.count(q), 1u);
  EXPECT_LT(run.log.rows(), exact.log.rows());
}

void expect_refused(const RecordingSpec& spec, const char* key) {
  try {
    check_recording(1, kPeriod_s, spec);
    FAIL() << key;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_EQ(error.where(), std::string("recording.") + key);
  }
}

TEST(Recording, ImpossibleValuesAreRefused) {
  expect_refused({.jitter_s = -1e-3}, "jitter_s");
  expect_refused({.stamp_resolution_s = 0.02}, "stamp_resolution_s");
  expect_refused({.lost = 1.0}, "lost");
  expect_refused({.lost = -0.1}, "lost");
  expect_refused({.torque_late_rows = -1}, "torque_late_rows");
  expect_refused({.velocity_filter_s = -0.01}, "velocity_filter_s");
  expect_refused({.torque_resolution = {-1.0}}, "torque_resolution");
  expect_refused({.torque_resolution = {1.0, 1.0}}, "torque_resolution");
}

}  // namespace
}  // namespace faultline
