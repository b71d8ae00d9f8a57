// SPDX-License-Identifier: MIT
#include "lib/residual/residuals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "lib/core/error.hpp"
#include "lib/log/log_source.hpp"
#include "lib/residual/learn_residual.hpp"
#include "tests/support/bench_motion.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;

LearnedResidual learn_on(const Log& log, const ResidualOptions& options) {
  MemorySource source(log, "healthy", 1000);
  LogSource* logs[] = {&source};
  return learn_residual_generator(logs, bench_robot(), 0.0, options);
}

const BenchMotion kHealthy{.duration_s = 150.0, .seed = 1};
const ResidualOptions kQuick{.hidden = {20}, .max_patterns = 1200, .max_iterations = 30};

const ResidualGenerator& quick_generator() {
  static const ResidualGenerator generator = learn_on(bench_log(bench_robot(), kHealthy), kQuick).generator;
  return generator;
}

/// 1 kHz: step 20 rows, stride 6, mean torque among the inputs.
const ResidualGenerator& fast_generator() {
  static const ResidualGenerator generator =
      learn_on(bench_log(bench_robot(), {.duration_s = 20.0, .log_period_s = 0.001, .noise = 1e-4}), kQuick)
          .generator;
  return generator;
}

Residuals all_residuals(const ResidualGenerator& generator, const Log& log, int segment_rows) {
  MemorySource source(log, "run", segment_rows);
  ResidualState state;
  Residuals all;
  Log segment;
  const auto join = [](MatrixXd& mine, const MatrixXd& more) {
    const Eigen::Index before = mine.cols();
    mine.conservativeResize(more.rows(), before + more.cols());
    mine.rightCols(more.cols()) = more;
  };
  while (source.next(segment)) {
    const Residuals part = compute_residuals(generator, segment, state);
    all.row.insert(all.row.end(), part.row.begin(), part.row.end());
    all.time.conservativeResize(all.time.size() + part.time.size());
    all.time.tail(part.time.size()) = part.time;
    join(all.position, part.position);
    join(all.velocity, part.velocity);
    join(all.torque, part.torque);
    join(all.tau, part.tau);
    join(all.ratio, part.ratio);
  }
  return all;
}

bool same_bytes(const MatrixXd& a, const MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

void expect_same(const Residuals& a, const Residuals& b) {
  EXPECT_EQ(a.row, b.row);
  EXPECT_TRUE(same_bytes(a.time, b.time));
  EXPECT_TRUE(same_bytes(a.position, b.position));
  EXPECT_TRUE(same_bytes(a.velocity, b.velocity));
  EXPECT_TRUE(same_bytes(a.torque, b.torque));
  EXPECT_TRUE(same_bytes(a.tau, b.tau));
  EXPECT_TRUE(same_bytes(a.ratio, b.ratio));
}

TEST(Residuals, SegmentBordersChangeNoByte) {
  const Log log =
      bench_log(bench_robot(), {.duration_s = 3.0, .log_period_s = 0.001, .noise = 1e-4, .seed = 4});
  const Residuals whole = all_residuals(fast_generator(), log, 100000);
  EXPECT_EQ(whole.count(), (2979 / 6) + 1);
  for (int rows : {1, 7, 4096}) expect_same(all_residuals(fast_generator(), log, rows), whole);
}

TEST(Residuals, SegmentBordersChangeNoByteWithoutVelocity) {
  Log log = bench_log(bench_robot(), {.duration_s = 30.0, .log_period_s = 0.005});
  log.dq.clear();
  const LearnedResidual learned = learn_on(log, kQuick);
  EXPECT_TRUE(learned.generator.shape.derive_velocity);
  const Residuals whole = all_residuals(learned.generator, log, 100000);
  EXPECT_EQ(whole.row.front(), 2 * learned.generator.shape.step);
  for (int rows : {1, 7, 4096}) expect_same(all_residuals(learned.generator, log, rows), whole);
}

TEST(Residuals, EveryRowLiesInAPrediction) {
  for (const ResidualGenerator* generator : {&quick_generator(), &fast_generator()}) {
    EXPECT_LE(generator->shape.stride, generator->shape.step);
    EXPECT_GE(generator->shape.stride, 1);
  }
}

TEST(Residuals, AreAboutOneOnAnotherHealthyLog) {
  const Residuals r =
      all_residuals(quick_generator(), bench_log(bench_robot(), {.duration_s = 150.0, .seed = 9}), 4096);
  for (int j = 0; j < 3; ++j) {
    const double rms = std::sqrt(r.velocity.row(j).squaredNorm() / r.count());
    EXPECT_GT(rms, 0.3) << j;
    EXPECT_LT(rms, 3.0) << j;
    EXPECT_LT(std::sqrt(r.position.row(j).squaredNorm() / r.count()), 3.0) << j;
  }
}

Log log_with_free_joint(int joint) {
  return bench_log(bench_robot(), {.duration_s = 6.0,
                                   .log_period_s = 0.001,
                                   .noise = 1e-4,
                                   .free_joint = joint,
                                   .fault_s = 4.5,
                                   .seed = 5});
}

TEST(Residuals, ResidualsOfAFreeJointShowItsMissingTorqueAtThatJoint) {
  const ResidualGenerator physics =
      learn_on(bench_log(bench_robot(), {.duration_s = 20.0, .log_period_s = 0.001, .noise = 1e-4}),
               {.kind = ResidualKind::physics})
          .generator;
  for (int joint : {1, 2, 3}) {
    const Residuals r = all_residuals(physics, log_with_free_joint(joint), 4096);
    for (int i = 0; i < r.count(); ++i) {
      if (r.time[i] < 4.525 || r.time[i] > 4.6) continue;
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(r.ratio(j, i), j == joint - 1 ? -1.0 : 0.0, 0.2)
            << "fault in " << joint << " at " << r.time[i];
    }
  }
}

TEST(Residuals, ResidualsOfTheNetworkGrowAtOnceForAFreeJoint) {
  for (int joint : {1, 2, 3}) {
    const Residuals r = all_residuals(fast_generator(), log_with_free_joint(joint), 4096);
    const auto rms = [&](double from_s, double to_s) {
      double sum = 0.0;
      int count = 0;
      for (int i = 0; i < r.count(); ++i)
        if (r.time[i] > from_s && r.time[i] < to_s) sum += std::pow(r.torque(joint - 1, i), 2), ++count;
      return std::sqrt(sum / count);
    };
    EXPECT_GT(rms(4.515, 4.555), 5.0 * rms(0.0, 4.49)) << joint;
  }
}

TEST(Residuals, MissingNumbersAndGapsGiveNaN) {
  Log log = bench_log(bench_robot(), {.duration_s = 20.0});
  log.q[1][50] = std::numeric_limits<double>::quiet_NaN();
  for (int i = 120; i < log.rows(); ++i) log.time[i] += 0.5;
  const Residuals r = all_residuals(quick_generator(), log, 64);
  for (int i = 0; i < r.count(); ++i) {
    const bool inputs_missing = r.row[i] == 51 || r.row[i] == 120;
    EXPECT_EQ(r.velocity.col(i).array().isNaN().all(), inputs_missing) << r.row[i];
    EXPECT_EQ(std::isnan(r.position(1, i)), inputs_missing || r.row[i] == 50) << r.row[i];
  }
}

TEST(Residuals, AnotherRobotsLogIsRefused) {
  Log log = bench_log(bench_robot(), {.duration_s = 2.0});
  log.q.pop_back();
  ResidualState state;
  EXPECT_THROW(compute_residuals(quick_generator(), log, state), Error);
}

TEST(Residuals, ALogWithoutTorqueHasNoResiduals) {
  Log log = bench_log(bench_robot(), {.duration_s = 2.0});
  log.tau.clear();
  ResidualState state;
  EXPECT_EQ(compute_residuals(quick_generator(), log, state).count(), 0);
}

TEST(Residuals, ALogWithoutVelocitiesHasResidualsFromItsPositions) {
  Log log = bench_log(bench_robot(), {.duration_s = 2.0});
  log.dq.clear();
  ResidualState state;
  const Residuals residuals = compute_residuals(quick_generator(), log, state);
  EXPECT_GT(residuals.count(), 0);
  EXPECT_TRUE(std::isfinite(residuals.velocity(0, residuals.count() - 1)));
}

}  // namespace
}  // namespace faultline
