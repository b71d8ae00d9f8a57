// SPDX-License-Identifier: MIT
#include "lib/plausibility/column_interpretation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

/// Three joints that move by 100, in degrees or mm, without velocities.
std::vector<Log> log_in_degrees() {
  Log log;
  log.time = {0.0, 1.0};
  log.q.assign(3, {0.0, 100.0});
  log.tau.assign(3, {1.0, 2.0});
  return {log};
}

TEST(ColumnInterpretation, TheInterpretationOfLeastScoreBelowTheLimitIsBest) {
  const auto all = column_interpretations(preset_robot("RRP").chain);
  const auto distance = [](const ColumnInterpretation&,
                           const std::vector<Log>& logs) -> std::optional<double> {
    return std::abs(logs[0].q[1][1] - 1.745) + std::abs(logs[0].q[0][1] - 100.0);
  };
  const auto* best = best_interpretation(all, log_in_degrees(), {}, 1.0, distance);
  ASSERT_NE(best, nullptr);
  EXPECT_EQ(best->what, "q2 and dq2 are in deg and deg/s");
  EXPECT_EQ(best->cure, "write unit = \"deg\" for q2 and \"deg/s\" for dq2 into [log.columns]");
  EXPECT_EQ(best_interpretation(all, log_in_degrees(), {}, 1e-9, distance), nullptr);
}

TEST(ColumnInterpretation, AnInterpretationThatHidesTheMotionOfAJointIsNotScored) {
  const auto all = column_interpretations(preset_robot("RRP").chain);
  const auto least_motion = [](const ColumnInterpretation&, const std::vector<Log>& logs) {
    return std::optional(logs[0].q[0][1]);
  };
  const auto* best = best_interpretation(all, log_in_degrees(), {50.0, 50.0, 50.0}, 200.0, least_motion);
  ASSERT_NE(best, nullptr);
  EXPECT_EQ(best->what.find("deg"), std::string::npos) << best->what;
}

}  // namespace
}  // namespace faultline
