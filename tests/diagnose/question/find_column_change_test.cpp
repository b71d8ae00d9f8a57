// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <tuple>

#include "lib/diagnose/question/check_interpretation.hpp"
#include "lib/log/log_source.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

constexpr int kChangedRow = 400;  // from 0
constexpr double kChange_s = 4.0;
constexpr double kDegrees = 180.0 / std::numbers::pi;

std::optional<ColumnChange> change_of(const Log& log) {
  MemorySource source(log);
  const Robot robot = known_rrp();
  return find_column_change(source, {robot, rrp_usual_motion()}, kChange_s);
}

void scale_behind(std::vector<double>& values, double by) {
  for (std::size_t i = kChangedRow; i < values.size(); ++i) values[i] *= by;
}

void swap_behind(std::vector<double>& a, std::vector<double>& b) {
  std::swap_ranges(a.begin() + kChangedRow, a.end(), b.begin() + kChangedRow);
}

TEST(ColumnChange, IsNamedWithItsRow) {
  const std::vector<std::pair<const char*, std::function<void(Log&)>>> changes = {
      {"q2 and dq2 are in deg",
       [](Log& log) { scale_behind(log.q[1], kDegrees), scale_behind(log.dq[1], kDegrees); }},
      {"in mm", [](Log& log) { scale_behind(log.q[2], 1e3), scale_behind(log.dq[2], 1e3); }},
      {"tau1 is in a unit", [](Log& log) { scale_behind(log.tau[0], 1e3); }},
      {"tau2 has the opposite sign", [](Log& log) { scale_behind(log.tau[1], -1.0); }},
      {"dq1 has the opposite sign", [](Log& log) { scale_behind(log.dq[0], -1.0); }},
      {"joints 1 and 2 are swapped", [](Log& log) {
         for (JointSignals* signals : {&log.q, &log.dq, &log.tau}) swap_behind((*signals)[0], (*signals)[1]);
       }}};
  for (const auto& [what, change] : changes) {
    Log log = simulate(known_rrp(), rrp_run(10.0), 71).log;
    change(log);
    const auto found = change_of(log);
    ASSERT_TRUE(found) << what;
    EXPECT_NE(found->what.find(what), std::string::npos) << what << ": said " << found->what;
    EXPECT_NEAR(static_cast<double>(found->row), kChangedRow + 1, 1.0);
  }
}

TEST(ColumnChange, IsNotFoundInALogWithAFaultOfTheRobot) {
  for (const auto& [kind, joint, size] :
       {std::tuple{FaultKind::torque_loss, 1_joint, 0.6},
        std::tuple{FaultKind::friction_increase, 2_joint, 5.0},
        std::tuple{FaultKind::sensor_bias, 1_joint, 0.1}, std::tuple{FaultKind::locked, 2_joint, 0.0},
        std::tuple{FaultKind::free_swinging, 1_joint, 0.0},
        std::tuple{FaultKind::free_swinging, 2_joint, 0.0},
        std::tuple{FaultKind::stuck_encoder, 2_joint, 0.0},
        std::tuple{FaultKind::torque_sensor_error, 1_joint, 5.0},
        std::tuple{FaultKind::payload_change, 3_joint, 2.0}}) {
    const Log log = simulate(known_rrp(), rrp_run_with(kind, joint, kChange_s, size), 73).log;
    const auto found = change_of(log);
    EXPECT_FALSE(found) << to_string(kind) << ": " << found->what;
  }
}

TEST(ColumnChange, IsNotFoundAtAJumpOfAPosition) {
  Log log = simulate(known_rrp(), rrp_run(10.0), 74).log;
  for (int k = kChangedRow; k < log.rows(); ++k) log.q[1][k] += 1.0;
  const auto found = change_of(log);
  EXPECT_FALSE(found) << found->what;
}

TEST(ColumnChange, IsNotFoundInAHealthyLog) {
  EXPECT_FALSE(change_of(simulate(known_rrp(), rrp_run(10.0), 72).log));
}

}  // namespace
}  // namespace faultline
