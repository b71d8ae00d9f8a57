// SPDX-License-Identifier: MIT
#include "lib/evidence/learn/carried_levels.hpp"

#include <gtest/gtest.h>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

constexpr int kLogs = 6, kMotions = 8;
constexpr double kStd = 0.05;

using Logs = std::vector<std::vector<CarriedLevel>>;

/// Motions whose levels scatter by .05 kg around what `kg(log, motion)` says; the last axis goes as
/// `way(motion)`.
template <typename Kg, typename Way>
Logs logs_of(const Kg& kg, const Way& way) {
  Random random(7);
  Logs logs(kLogs);
  for (int i = 0; i < kLogs; ++i)
    for (int k = 0; k < kMotions; ++k)
      logs[i].push_back({kg(i, k) + kStd * random.normal(), kStd, 100 * k, {0.0, 0.0, way(k)}});
  return logs;
}

double both_ways(int motion) { return motion / 2 % 2 == 0 ? 0.1 : -0.1; }

TEST(CarriedLevels, APieceInEverySecondMotionIsFound) {
  const Logs logs = logs_of([](int, int k) { return k % 2 == 0 ? -0.3 : 0.5; }, both_ways);
  EXPECT_NEAR(piece_that_comes_and_goes(logs).kg, 0.8, 0.05);
}

TEST(CarriedLevels, MotionsThatAreKnownBadlyAreLeftOut) {
  Logs logs = logs_of([](int, int k) { return k % 2 == 0 ? -0.3 : 0.5; }, both_ways);
  for (auto& log : logs) log.push_back({3.0, 1.0, 900, {}});
  EXPECT_NEAR(piece_that_comes_and_goes(logs).kg, 0.8, 0.05);
}

TEST(CarriedLevels, LevelsThatScatterAroundOneMassAreNoPiece) {
  EXPECT_EQ(piece_that_comes_and_goes(logs_of([](int, int) { return 0.1; }, both_ways)).kg, 0.0);
}

TEST(CarriedLevels, AToolThatDiffersFromDayToDayIsNoPiece) {
  EXPECT_EQ(piece_that_comes_and_goes(logs_of([](int i, int) { return i < 3 ? 0.0 : 0.8; }, both_ways)).kg,
            0.0);
}

TEST(CarriedLevels, WhatDiffersWithTheWayOfASlidingAxisIsItsFriction) {
  const auto kg = [](int, int k) { return k % 2 == 0 ? -0.3 : 0.5; };
  EXPECT_EQ(piece_that_comes_and_goes(logs_of(kg, [](int k) { return k % 2 == 0 ? 0.1 : -0.1; })).kg, 0.0);
}

TEST(CarriedLevels, TooFewMotionsTellNothing) {
  Logs logs = logs_of([](int, int k) { return k % 2 == 0 ? -0.3 : 0.5; }, both_ways);
  logs.resize(1);
  EXPECT_EQ(piece_that_comes_and_goes(logs).kg, 0.0);
  EXPECT_EQ(piece_that_comes_and_goes({}).kg, 0.0);
}

TEST(CarriedLevels, ChangesLieInTheRestsBeforeMotionsThatAreKnownWell) {
  const Logs logs = logs_of([](int, int k) { return k % 2 == 0 ? -0.3 : 0.5; }, both_ways);
  const ShownPiece piece = piece_that_comes_and_goes(logs);
  std::vector<CarriedLevel> log(logs[0].begin(), logs[0].begin() + 4);
  log[2].std = 1.0;  // carries nothing, but who knows
  const std::vector<WorkPieceChange> changes = changes_between(log, piece);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].row, 100);
  EXPECT_NEAR(changes[0].kg, 0.8, 0.05);
}

}  // namespace
}  // namespace faultline
