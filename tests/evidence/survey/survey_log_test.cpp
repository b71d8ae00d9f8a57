// SPDX-License-Identifier: MIT
#include "lib/evidence/survey/survey_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/core/random.hpp"
#include "lib/log/memory_source.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

LogDay day_of(const Log& log) {
  MemorySource source(log);
  return survey_log(source, rrp_motion_model());
}

Log healthy() { return simulate(known_rrp(), rrp_run(10.0), 71).log; }

TEST(SurveyLog, ALogLikeTheLearnedOnesChangesNothing) {
  const LogDay day = day_of(healthy());
  EXPECT_TRUE(day.notes.empty());
  EXPECT_TRUE(day.torque_delay_s.empty());
  EXPECT_EQ(day.model.steady_period_s, rrp_motion_model().steady_period_s);
}

TEST(SurveyLog, ATorqueLoggedARowLateIsTakenWhereItActs) {
  Log log = healthy();
  for (auto& tau : log.tau) std::rotate(tau.rbegin(), tau.rbegin() + 1, tau.rend());
  MotionModel exact = rrp_motion_model();  // a model that misses little torque
  for (SlowState& slow : exact.slow)
    if (slow.kind == SlowKind::coloured_torque) slow.day_std *= 0.1;
  MemorySource source(log);
  const LogDay day = survey_log(source, exact);
  ASSERT_EQ(day.torque_delay_s.size(), 3u);
  EXPECT_NEAR(day.torque_delay_s[0], -(log.time[1] - log.time[0]), 1e-9);
  EXPECT_NE(day.notes.find("torque_timing"), nullptr);
}

TEST(SurveyLog, StampsThatWobbleAreTakenInStep) {
  Log log = healthy();
  const double period = log.time[1] - log.time[0];
  Random random(5);
  for (double& t : log.time) t += 0.2 * period * random.normal();
  std::sort(log.time.begin(), log.time.end());
  const LogDay day = day_of(log);
  EXPECT_NEAR(day.model.steady_period_s, period, 0.001 * period);
  EXPECT_NE(day.notes.find("stamps_wobble"), nullptr);
}

TEST(SurveyLog, RippleFromTheFirstRowsOnIsARougherTorque) {
  Log log = healthy();
  const MotionModel& model = rrp_motion_model();
  for (int k = 0; k < log.rows(); ++k)
    log.tau[0][k] += 0.03 * model.torque_scale[0] * std::sin(40.0 * log.q[0][k]);
  const LogDay day = day_of(log);
  EXPECT_NE(day.notes.find("torque_rough"), nullptr);
  const auto level = [](const MotionModel& m) {
    for (const SlowState& slow : m.slow)
      if (slow.kind == SlowKind::coloured_torque && slow.joint == 0) return slow.day_std;
    return 0.0;
  };
  EXPECT_GT(level(day.model), level(model));
}

TEST(SurveyLog, ASlowRippleIsARougherTorqueThoughSlowStatesHideItAtFirst) {
  Log log = healthy();
  const MotionModel& model = rrp_motion_model();
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < log.rows(); ++k)
      log.tau[j][k] += 0.03 * model.torque_scale[j] * std::sin((j < 2 ? 7.0 : 60.0) * log.q[j][k]);
  const LogDay day = day_of(log);
  EXPECT_NE(day.notes.find("torque_rough"), nullptr);
  ASSERT_EQ(day.roughness.size(), 3u);
  EXPECT_GT(*std::max_element(day.roughness.begin(), day.roughness.end()), 2.0);
}

TEST(SurveyLog, AFaultAmongTheFirstRowsIsNotExcused) {
  const FaultKind kinds[] = {FaultKind::free_swinging, FaultKind::collision, FaultKind::sensor_bias};
  for (const FaultKind kind : kinds) {
    SimulationSpec spec = rrp_run_with(kind, 1, 2.5, kind == FaultKind::sensor_bias ? 0.05 : 20.0);
    if (kind == FaultKind::collision) spec.faults.back().end_s = 2.6;
    EXPECT_TRUE(day_of(simulate(known_rrp(), spec, 72).log).notes.empty()) << to_string(kind);
  }
}

TEST(SurveyLog, WhatOnlyTheSecondStretchAsksForMayBeAFault) {
  SimulationSpec spec = rrp_run_with(FaultKind::friction_increase, 3, 0.9, 40.0);
  spec.duration_s = 5.0;
  spec.motion.dwell_min_s = spec.motion.dwell_max_s = 0.01;
  const LogDay day = day_of(simulate(known_rrp(), spec, 73).log);
  EXPECT_EQ(day.notes.find("torque_rough"), nullptr);
}

TEST(SurveyLog, NoiseOfCoarseRowsIsToldByTheFilter) {
  MotionModel coarse = rrp_motion_model();  // its third differences hold more motion than noise
  coarse.usual_noise = {{1e-3, 1e-3, 1e-3}, {0.1, 0.1, 0.1}};
  Log log = healthy();
  Random random(6);
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < log.rows(); ++k) {
      log.q[j][k] += 1.7 * coarse.q_std[j] * random.normal();
      log.dq[j][k] += 1.7 * coarse.dq_std[j] * random.normal();
    }
  MemorySource source(log);
  const LogDay day = survey_log(source, coarse);
  EXPECT_NE(day.notes.find("noisy_readings"), nullptr);
  EXPECT_GT(day.noise.q_scale[0], 1.3);
}

}  // namespace
}  // namespace faultline
