// SPDX-License-Identifier: MIT
#include "lib/log/transformed/converted_torque_source.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/log/log_source.hpp"

namespace faultline {
namespace {

/// Torque of both joints is 10 t + joint, a row every 2 ms.
Log ramp(int rows) {
  Log log;
  log.q.resize(2);
  log.tau.resize(2);
  for (int k = 0; k < rows; ++k) {
    log.time.push_back(0.002 * k);
    for (int j = 0; j < 2; ++j) {
      log.q[j].push_back(k);
      log.tau[j].push_back(10.0 * log.time[k] + j);
    }
  }
  return log;
}

Log delayed(const std::vector<double>& delay_s, int segment_rows) {
  MemorySource source(ramp(500), "ramp", segment_rows);
  ConvertedTorqueSource late(source, delay_s);
  return read_all(late);
}

TEST(ConvertedTorqueSource, TorqueIsThatOfATimeEarlierByTheDelay) {
  for (const int segment_rows : {1, 7, 500}) {
    const Log log = delayed({0.006, -0.003}, segment_rows);
    ASSERT_EQ(log.rows(), 500);
    for (int k = 0; k < 500; ++k) {
      EXPECT_EQ(log.q[0][k], k);
      EXPECT_NEAR(log.tau[0][k], 10.0 * std::max(log.time[k] - 0.006, 0.0), 1e-12);
      EXPECT_NEAR(log.tau[1][k], 1.0 + 10.0 * std::min(log.time[k] + 0.003, 0.998), 1e-12);
    }
  }
}

TEST(ConvertedTorqueSource, ADelayOfWholeSamplesGivesTheRecordedValues) {
  const Log log = delayed({0.004, 0.0}, 13), raw = ramp(500);
  for (int k = 2; k < 500; ++k) EXPECT_NEAR(log.tau[0][k], raw.tau[0][k - 2], 1e-13);
  EXPECT_EQ(log.tau[1], raw.tau[1]);
}

TEST(ConvertedTorqueSource, GainsMultiplyTheTorqueOfTheirJoints) {
  MemorySource source(ramp(50), "ramp", 7);
  ConvertedTorqueSource scaled(source, {{}, {1.0, 1.25}});
  const Log log = read_all(scaled), raw = ramp(50);
  EXPECT_EQ(log.tau[0], raw.tau[0]);
  for (int k = 0; k < 50; ++k) EXPECT_EQ(log.tau[1][k], 1.25 * raw.tau[1][k]);
}

TEST(ConvertedTorqueSource, TorquesAreCutToTheLimitOfTheirDriveAfterTheGain) {
  MemorySource source(ramp(50), "ramp", 7);
  ConvertedTorqueSource limited(source, {{}, {2.0, 1.0}, {0.5, 0.0}});
  const Log log = read_all(limited), raw = ramp(50);
  for (int k = 0; k < 50; ++k) EXPECT_EQ(log.tau[0][k], std::min(2.0 * raw.tau[0][k], 0.5));
  EXPECT_EQ(log.tau[1], raw.tau[1]) << "0 is no limit";
}

TEST(ConvertedTorqueSource, RewindGivesTheSameRowsAgain) {
  MemorySource source(ramp(100), "ramp", 9);
  ConvertedTorqueSource late(source, {{0.006, -0.003}});
  const Log once = read_all(late);
  late.rewind();
  EXPECT_EQ(read_all(late).tau, once.tau);
}

}  // namespace
}  // namespace faultline
