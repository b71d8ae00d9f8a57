// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/log/derived_velocity.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/resample.hpp"

namespace faultline {
namespace {

/// An unevenly sampled parabola and a sine with a missing value, and a gap in the middle.
Log parabola() {
  Log log;
  log.q.resize(2);
  for (int i = 0; i < 400; ++i) {
    const double t = 0.01 * i + (i % 3 == 0 ? 0.001 : 0.0) + (i >= 200 ? 1.0 : 0.0);
    log.time.push_back(t);
    log.q[0].push_back(3.0 * t * t - t + 2.0);
    log.q[1].push_back(i == 50 ? std::nan("") : std::sin(5.0 * t));
  }
  return log;
}

std::unique_ptr<LogSource> source_of(const Log& log, int segment_rows) {
  return std::make_unique<MemorySource>(log, "memory", segment_rows);
}

void expect_same(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]))) << i;
}

TEST(Derive, ParabolaHasItsExactVelocityToTheEnds) {
  const Log log = read_all(*with_velocity(source_of(parabola(), 4096)));
  ASSERT_EQ(log.rows(), 400);
  for (int i = 0; i < log.rows(); ++i) EXPECT_NEAR(log.dq[0][i], 6.0 * log.time[i] - 1.0, 1e-8) << i;
}

TEST(Derive, AMissingPositionDoesNotAffectNeighbouringVelocities) {
  const Log log = read_all(*with_velocity(source_of(parabola(), 4096)));
  for (int i = 45; i < 55; ++i) EXPECT_NEAR(log.dq[1][i], 5.0 * std::cos(5.0 * log.time[i]), 0.03) << i;
}

TEST(Derive, BordersOfSegmentsChangeNothing) {
  const Log whole = read_all(*with_velocity(source_of(parabola(), 4096)));
  for (const int rows : {1, 2, 3, 7, 399}) {
    const Log parts = read_all(*with_velocity(source_of(parabola(), rows)));
    expect_same(parts.time, whole.time);
    for (int j = 0; j < 2; ++j) expect_same(parts.dq[j], whole.dq[j]);
  }
}

TEST(Derive, RecordedVelocitiesStay) {
  Log log = parabola();
  log.dq = {std::vector<double>(400, 7.0), std::vector<double>(400, 8.0)};
  EXPECT_EQ(read_all(*with_velocity(source_of(log, 100))).dq, log.dq);
}

TEST(Derive, TwoRowsGiveNoVelocity) {
  const Log log = read_all(*with_velocity(source_of(slice(parabola(), 0, 2), 4096)));
  ASSERT_EQ(log.rows(), 2);
  EXPECT_TRUE(std::isnan(log.dq[0][0]) && std::isnan(log.dq[0][1]));
}

Log read_resampled(std::unique_ptr<LogSource> source, const ResampleOptions& options) {
  return read_all(*resampled(*source, options));
}

TEST(Resample, SamplesAreInterpolatedLinearly) {
  Log log;
  log.time = {0.0, 1.0, 2.0, 3.0};
  log.q = {{0.0, 10.0, 20.0, std::nan("")}};
  const Log made = read_resampled(source_of(log, 4096), {.period_s = 0.5});
  ASSERT_EQ(made.rows(), 7);
  EXPECT_EQ(made.time, (std::vector<double>{0, 0.5, 1, 1.5, 2, 2.5, 3}));
  EXPECT_EQ(made.q[0][1], 5.0);
  EXPECT_EQ(made.q[0][4], 20.0);
  EXPECT_TRUE(std::isnan(made.q[0][5]));
}

TEST(Resample, NoRowsAreMadeInsideGaps) {
  const Log made = read_resampled(source_of(parabola(), 4096), {.period_s = 0.01});
  for (const double t : made.time) EXPECT_FALSE(t > 2.0 && t < 2.999) << t;
  EXPECT_NEAR(static_cast<double>(made.rows()), 400.0, 3.0);
}

TEST(Resample, BordersOfSegmentsChangeNothing) {
  const ResampleOptions options{.period_s = 0.0037};
  const Log whole = read_resampled(source_of(parabola(), 4096), options);
  ASSERT_GT(whole.rows(), 900);
  for (const int rows : {1, 2, 7, 201}) {
    const Log parts = read_resampled(source_of(parabola(), rows), options);
    expect_same(parts.time, whole.time);
    expect_same(parts.q[0], whole.q[0]);
    expect_same(parts.q[1], whole.q[1]);
  }
}

TEST(Resample, APeriodThatIsNotPositiveIsRefused) {
  EXPECT_THROW(read_resampled(source_of(parabola(), 10), {.period_s = 0.0}), Error);
  EXPECT_THROW(read_resampled(source_of(parabola(), 10), {.period_s = std::nan("")}), Error);
}

/// Torque in pulses of one row, which rows picked from the log would miss or count twice.
Log pulses() {
  Log log;
  log.q.resize(1), log.tau.resize(1);
  for (int i = 0; i < 1000; ++i) {
    log.time.push_back(5.0 + 0.002 * i);
    log.q[0].push_back(std::sin(0.01 * i));
    log.tau[0].push_back(i % 7 == 3 ? 7.0 : 0.0);
  }
  return log;
}

TEST(Resample, TorqueKeepsItsImpulse) {
  for (const double phi : {0.0, 0.5})
    for (const double period : {0.0025, 0.0073, 0.1}) {
      const Log made = read_resampled(source_of(pulses(), 64), {.period_s = period, .torque_phi = phi});
      double impulse = 0.0;
      for (int k = 2; k + 2 < made.rows(); ++k)
        impulse += period * ((1.0 - phi) * made.tau[0][k] + phi * made.tau[0][k + 1]);
      const double lasts = made.time[made.rows() - 2] - made.time[2];
      EXPECT_NEAR(impulse / lasts, 1.0, 0.02 / lasts) << period << " " << phi;
    }
}

TEST(Resample, AWholeMultipleOfThePeriodPicksTheRowsThatASlowerRecorderWrites) {
  const Log log = pulses();
  const Log made = read_resampled(source_of(log, 64), {.period_s = 0.01});
  ASSERT_EQ(made.rows(), 200);
  for (int k = 0; k < made.rows(); ++k) {
    EXPECT_NEAR(made.time[k], log.time[5 * k], 1e-12);
    EXPECT_NEAR(made.q[0][k], log.q[0][5 * k], 1e-12);
  }
}

TEST(Resample, BordersOfSegmentsChangeNoTorque) {
  for (const double period : {0.0015, 0.0025, 0.031}) {
    const ResampleOptions options{.period_s = period, .torque_phi = 0.5};
    const Log whole = read_resampled(source_of(pulses(), 4096), options);
    for (const int rows : {1, 3, 100})
      EXPECT_EQ(read_resampled(source_of(pulses(), rows), options).tau, whole.tau);
  }
}

TEST(Resample, BeginsAgainAfterRewind) {
  const std::unique_ptr<LogSource> recorded = source_of(pulses(), 64);
  const auto source = resampled(*recorded, {.period_s = 0.0025});
  const Log once = read_all(*source);
  source->rewind();
  EXPECT_EQ(read_all(*source).tau, once.tau);
}

}  // namespace
}  // namespace faultline
