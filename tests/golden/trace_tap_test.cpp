// SPDX-License-Identifier: MIT
#include "lib/golden/trace_tap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formats/open_log.hpp"
#include "lib/golden/golden_folder.hpp"
#include "lib/log/log_source.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

const std::string kFolder = FAULTLINE_SOURCE_DIR "/sample_logs/golden";

class GoldenTrace : public testing::Test {
 protected:
  GoldenTrace() : model_(load_golden_model(kFolder, load_golden(kFolder)).model) {
    log_ = read_all(*open_log(kFolder + "/logs/healthy_quintic.csv"));
  }

  Trace trace(int max_points, int segment_rows) const {
    MemorySource source(log_, "memory", segment_rows);
    TraceTap tap(source, model_.residual, max_points);
    Log passed;
    for (Log segment; tap.next(segment);) append(passed, segment);
    EXPECT_EQ(passed.q, log_.q) << "the log itself must pass as it is";
    return tap.trace();
  }

  Model model_;
  Log log_;
};

TEST_F(GoldenTrace, EqualsTheMeasurementMinusTheResidual) {
  const Trace whole = trace(500, 4096);
  ASSERT_EQ(whole.points(), log_.rows() - 1);
  EXPECT_EQ(whole.channels, (std::vector<std::string>{"q1", "q2", "q3", "dq1", "dq2", "dq3"}));
  ResidualState state;
  const Residuals residuals = compute_residuals(model_.residual, log_, state);
  for (int i = 0; i < whole.points(); ++i)
    for (int j = 0; j < 3; ++j) {
      EXPECT_EQ(whole.time[i], log_.time[i + 1]);
      const double residual = residuals.velocity(j, i) * model_.residual.healthy.velocity_rms[j];
      EXPECT_NEAR(whole.values[3 + j][i], log_.dq[j][i + 1] - residual, 1e-12);
    }
}

TEST_F(GoldenTrace, DoesNotDependOnSegments) {
  for (const int points : {500, 60}) {
    const Trace whole = trace(points, 4096);
    for (const int rows : {1, 37, 128}) {
      const Trace parts = trace(points, rows);
      EXPECT_EQ(parts.time, whole.time) << rows;
      EXPECT_EQ(parts.values, whole.values) << rows;
    }
  }
}

TEST_F(GoldenTrace, HoldsEveryEighthPointOfALongLog) {
  const Trace whole = trace(500, 4096), few = trace(50, 4096);
  ASSERT_EQ(few.points(), (whole.points() + 7) / 8);
  for (int i = 0; i < few.points(); ++i) {
    EXPECT_EQ(few.time[i], whole.time[8 * i]);
    EXPECT_EQ(few.values[5][i], whole.values[5][8 * i]);
  }
}

TEST_F(GoldenTrace, StartsAgainAfterRewind) {
  MemorySource source(log_);
  TraceTap tap(source, model_.residual, 500);
  Log segment;
  while (tap.next(segment)) {
  }
  const std::string first = trace_to_csv(tap.trace());
  tap.rewind();
  while (tap.next(segment)) {
  }
  EXPECT_EQ(trace_to_csv(tap.trace()), first);
}

}  // namespace
}  // namespace faultline
