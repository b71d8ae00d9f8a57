// SPDX-License-Identifier: MIT
#include "lib/simulate/work_piece.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/simulate/spec_file.hpp"
#include "tests/simulate/short_runs.hpp"

namespace faultline {
namespace {

constexpr WorkPieceSpec kPiece{
    .mass = 0.8, .carried_min_s = 0.5, .carried_max_s = 0.9, .empty_min_s = 1.0, .empty_max_s = 1.6};

TEST(WorkPiece, IsPickedUpAndPutDownWithinItsTimes) {
  const std::vector<SimulatedFault> pieces = carried(kPiece, 3, 200.0, Random(3));
  ASSERT_GT(pieces.size(), 70u);
  double put_down = 0.0, shortest = 1e9, longest = 0.0;
  for (const SimulatedFault& piece : pieces) {
    EXPECT_EQ(piece.size, 0.8);
    EXPECT_GE(piece.onset_s - put_down, 1.0 - 1e-9);
    EXPECT_LE(piece.onset_s - put_down, 1.6 + 1e-9);
    shortest = std::min(shortest, piece.end_s - piece.onset_s);
    longest = std::max(longest, piece.end_s - piece.onset_s);
    put_down = piece.end_s;
  }
  EXPECT_GE(shortest, 0.5 - 1e-9);
  EXPECT_LT(shortest, 0.55);
  EXPECT_LE(longest, 0.9 + 1e-9);
  EXPECT_GT(longest, 0.85);
  EXPECT_GT(put_down, 198.0) << "up to the end of the run";
  EXPECT_TRUE(carried({}, 3, 200.0, Random(3)).empty());
}

SimulationSpec carrying(double duration_s) {
  SimulationSpec spec = short_run(duration_s);
  spec.motion.points = {{0.3, -0.2, -0.1}};
  spec.work_piece = kPiece;
  return spec;
}

TEST(WorkPiece, AddsWeightToTheLogButIsNotInTheTruth) {
  Robot smooth = industrial();
  smooth.chain.friction[2] = {};
  SimulationSpec spec = carrying(10.0);
  spec.controller.bandwidth_rad_s = 60.0;  // soon holds what it carries
  const SimulatedRun run = simulate(smooth, spec, 5);
  const double empty = 2.5 * 9.81, full = 3.3 * 9.81;
  int changes = 0;
  bool was_full = false;
  int light = 0, heavy = 0;
  for (const double tau : run.log.tau[2]) {
    light += std::abs(tau - empty) < 0.5;
    heavy += std::abs(tau - full) < 0.5;
    const bool is_full = tau > 0.5 * (empty + full);
    changes += is_full != was_full;
    was_full = is_full;
  }
  EXPECT_GT(light, 3000);
  EXPECT_GT(heavy, 1000);
  EXPECT_GE(changes, 6);
  EXPECT_TRUE(run.truth.empty());
}

TEST(WorkPiece, AFaultBesideAWorkPieceIsTheOnlyTruth) {
  SimulationFile file;
  file.robot = industrial();
  RunSpec spec;
  spec.name = "carries";
  spec.simulation = carrying(4.0);
  spec.simulation.faults = {{FaultKind::collision, 1_joint, 2.0, 2.1, 20.0}};
  const SimulatedRun run = simulate(file.robot, spec.simulation);
  ASSERT_EQ(run.truth.size(), 1u);
  const std::string lines = label_lines(file, spec, run);
  EXPECT_EQ(lines.find("payload"), std::string::npos) << lines;
  EXPECT_NE(lines.find("collision"), std::string::npos) << lines;
}

TEST(WorkPiece, ChangesNeitherMotionNorNoise) {
  SimulationSpec spec = short_run(3.0);
  spec.noise.q = {1e-3, 1e-3, 1e-4};
  const Log empty = simulate(industrial(), spec, 4).log;
  spec.work_piece = kPiece;
  const Log full = simulate(industrial(), spec, 4).log;
  EXPECT_EQ(empty.q_ref, full.q_ref);
  for (int k = 0; k < 1000; ++k) ASSERT_EQ(empty.q[0][k], full.q[0][k]) << "the first second is empty";
  EXPECT_NE(empty.q[2][2000], full.q[2][2000]);
}

void expect_refused(const WorkPieceSpec& spec, const char* key) {
  try {
    check_work_piece(spec);
    FAIL() << key;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_EQ(error.where(), std::string("work_piece.") + key);
  }
}

TEST(WorkPiece, ImpossibleValuesAreRefused) {
  expect_refused({.mass = -1.0}, "mass");
  expect_refused({.mass = 1.0, .carried_min_s = 0.0}, "carried_s");
  expect_refused({.mass = 1.0, .carried_min_s = 2.0, .carried_max_s = 1.0}, "carried_s");
  expect_refused({.mass = 1.0, .empty_min_s = -1.0}, "empty_s");
}

}  // namespace
}  // namespace faultline
