// SPDX-License-Identifier: MIT
// Healthy robots that are not the one that was learned from, and faults in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lib/classify/episode_features.hpp"
#include "lib/evidence/bank.hpp"
#include "lib/evidence/motion_model_json.hpp"
#include "lib/evidence/slow_states.hpp"
#include "lib/evidence/survey/survey_log.hpp"
#include "lib/evidence/watch/episode_detector.hpp"
#include "lib/fault/label_text.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

constexpr double kOnset_s = 2.503;

/// Same robot, another day.
Robot with_friction(double factor) {
  Robot robot = known_rrp();
  for (Friction<double>& friction : robot.chain.friction) {
    friction.viscous *= factor;
    friction.coulomb *= factor;
  }
  return robot;
}

Robot with_masses(double factor) {
  Robot robot = known_rrp();
  set_masses_and_lengths(robot, {8.0 * factor, 5.0 * factor, 2.5 * factor}, {0.35, 0.3, 0.0});
  return robot;
}

SimulationSpec with_noise(SimulationSpec spec, double factor) {
  for (double& q : spec.noise.q) q *= factor;
  for (double& dq : spec.noise.dq) dq *= factor;
  return spec;
}

struct Watched {
  std::vector<EpisodeEvidence> episodes;
  std::vector<WorkPieceChange> changes;
  std::vector<SlowEstimate> slow;
  std::vector<SlowFault> slow_faults;

  const SlowEstimate& estimate(SlowKind kind, int joint) const {
    return *std::find_if(slow.begin(), slow.end(), [&](const SlowEstimate& e) {
      return e.state.kind == kind && e.state.joint == joint;
    });
  }
};

Watched watched(const Log& log, const MotionModel& model = rrp_motion_model()) {
  const std::vector<Hypothesis> bank =
      hypotheses_of(model.joints(), TorqueMeaning::commanded, model.work_pieces_kg);
  MemorySource source(log);
  EpisodeDetector detector(model, bank, {}, survey_noise(source, model));
  for (Log segment; source.next(segment);) detector.take(segment);
  detector.finish();
  return {detector.episodes(), detector.work_piece_changes(), detector.slow_estimates(),
          detector.slow_faults()};
}

TEST(HealthyFamily, FrictionOfAColdOrAWarmDayIsNoFault) {
  for (const double factor : {0.7, 1.2, 1.5})
    EXPECT_TRUE(watched(simulate(with_friction(factor), rrp_run(10.0), 31).log).episodes.empty()) << factor;
}

TEST(HealthyFamily, MassesTwoPercentOffAreNoFault) {
  for (const double factor : {0.98, 1.02})
    EXPECT_TRUE(watched(simulate(with_masses(factor), rrp_run(10.0), 32).log).episodes.empty()) << factor;
}

TEST(HealthyFamily, TwiceTheNoiseIsNoFault) {
  const Log log = simulate(known_rrp(), with_noise(rrp_run(10.0), 2.0), 33).log;
  MemorySource source(log);
  const LogNoise noise = survey_noise(source, rrp_motion_model());
  for (int j = 0; j < 3; ++j) EXPECT_NEAR(noise.q_scale[j], 2.0, 0.5);
  EXPECT_TRUE(watched(log).episodes.empty());
}

TEST(HealthyFamily, FaultsOfAnotherDayAreFoundAllTheSame) {
  const struct {
    FaultKind kind;
    int joint;
    double size;
  } cases[] = {
      {FaultKind::free_swinging, 2, 0.0}, {FaultKind::locked, 1, 0.0}, {FaultKind::sensor_bias, 1, 0.02}};
  for (const auto& fault : cases) {
    const Log log =
        simulate(with_friction(1.4), rrp_run_with(fault.kind, fault.joint, kOnset_s, fault.size), 34).log;
    const std::vector<EpisodeEvidence> episodes = watched(log).episodes;
    ASSERT_FALSE(episodes.empty()) << to_string(fault.kind);
    const auto bank = hypotheses_of(3, TorqueMeaning::commanded);
    const FaultLabel named = likeliest(evidence_by_label(episodes.front(), bank, rrp_motion_model())).label;
    EXPECT_EQ(label_text(named), label_text({fault.kind, fault.joint}));
    EXPECT_GE(episodes.front().alarm_s, kOnset_s);
    EXPECT_LT(episodes.front().alarm_s, kOnset_s + 0.3);
  }
}

TEST(HealthyFamily, AWorkPieceThatComesEveryDayIsNoFault) {
  MotionModel model = rrp_motion_model();
  model.work_pieces_kg = {1.0};
  const Log log = simulate(known_rrp(), rrp_run_with(FaultKind::payload_change, 3, kOnset_s, 1.0), 35).log;
  EXPECT_FALSE(watched(log).episodes.empty()) << "it is one where no work piece is known";
  const Watched with_piece = watched(log, model);
  EXPECT_TRUE(with_piece.episodes.empty());
  ASSERT_EQ(with_piece.changes.size(), 1u);
  EXPECT_EQ(with_piece.changes.front().kg, 1.0);
  EXPECT_NEAR(log.time[with_piece.changes.front().row], kOnset_s, 0.05);
  EXPECT_NEAR(with_piece.estimate(SlowKind::tip_mass, 2).value, 0.0, 0.05) << "the work piece is none of it";
}

TEST(HealthyFamily, AWorkPieceIsNotPickedUpForALittleSurprise) {
  MotionModel model = rrp_motion_model();
  model.work_pieces_kg = {1.0};
  for (const int seed : {35, 41, 42})
    EXPECT_TRUE(watched(simulate(with_friction(1.5), rrp_run(10.0), seed).log, model).changes.empty())
        << seed;
}

TEST(HealthyFamily, TheSameChangeOfTheWorkPieceTwiceInARowIsUnlikely) {
  MotionModel model = rrp_motion_model();
  model.work_pieces_kg = {1.0};
  const Log log = simulate(known_rrp(), rrp_run(1.0), 43).log;
  const std::vector<Hypothesis> hypotheses = hypotheses_of(3, TorqueMeaning::measured, model.work_pieces_kg);
  const auto picked_up = std::find_if(hypotheses.begin(), hypotheses.end(),
                                      [](const Hypothesis& h) { return h.work_piece_kg > 0.0; });
  Follower follower(model);
  Bank bank(model, follower.dynamics(), hypotheses);
  FollowedSample before, at;
  for (int k = 0; k < 50; ++k) follower.follow(log, k, before);
  follower.follow(log, 50, at);
  const int index = static_cast<int>(picked_up - hypotheses.begin());
  const auto ratio = [&] { return bank.start(index, 50, before, at).log_likelihood_ratio; };
  const double at_first = ratio();
  bank.work_piece_changed(-1.0);
  EXPECT_EQ(ratio(), at_first) << "it was put down";
  bank.work_piece_changed(1.0);
  EXPECT_LT(ratio(), at_first - 15.0);
}

TEST(HealthyFamily, TheConditionIsThatOfTheDay) {
  for (const double factor : {0.7, 1.0, 1.2, 1.5}) {
    const Watched day = watched(simulate(with_friction(factor), rrp_run(20.0), 51).log);
    for (int j = 0; j < 3; ++j) {
      const SlowEstimate& friction = day.estimate(SlowKind::friction, j);
      EXPECT_NEAR(friction.value, factor - 1.0, 0.05 + 3.0 * friction.std) << factor << ", joint " << j + 1;
      EXPECT_LT(friction.std, friction.state.day_std) << factor << ", joint " << j + 1;
    }
  }
}

/// A controller that answers the noise of its sensors, and a model with more process noise than the robot
/// has.
TEST(HealthyFamily, TheControllersAnswerToNoiseIsNotTakenForALighterRobot) {
  SimulationSpec spec = rrp_run(60.0);
  spec.sample_period_s = spec.control_period_s = 0.002;
  spec.controller.bandwidth_rad_s = 60.0;
  spec.noise.q = {1e-4, 1e-4, 2e-5};
  spec.noise.dq = {1e-2, 1e-2, 2e-3};
  MotionModel model = rrp_motion_model();
  allow_model_error(model, 0.02);
  const Watched day = watched(simulate(known_rrp(), spec, 54).log, model);
  EXPECT_TRUE(day.episodes.empty());
  for (int j = 0; j < 3; ++j) EXPECT_NEAR(day.estimate(SlowKind::torque_gain, j).value, 0.0, 0.03) << j + 1;
  EXPECT_NEAR(day.estimate(SlowKind::tip_mass, 2).value, 0.0, 0.05);
}

TEST(HealthyFamily, OnlyFrictionFarBeyondItsRangeIsAFaultFromTheFirstRow) {
  for (const double factor : {0.5, 1.0, 1.5})
    EXPECT_TRUE(watched(simulate(with_friction(factor), rrp_run(20.0), 53).log).slow_faults.empty())
        << factor;
  const Watched stiff = watched(simulate(with_friction(2.5), rrp_run(20.0), 53).log);
  EXPECT_FALSE(stiff.slow_faults.empty() && stiff.episodes.empty());
}

TEST(HealthyFamily, AFaultLeavesTheConditionAsItWasBefore) {
  SimulationSpec spec = rrp_run_with(FaultKind::locked, 1, 9.0);
  spec.duration_s = 15.0;
  const Watched day = watched(simulate(with_friction(1.2), spec, 52).log);
  ASSERT_FALSE(day.episodes.empty());
  for (int j = 0; j < 3; ++j) EXPECT_NEAR(day.estimate(SlowKind::friction, j).value, 0.2, 0.1) << j;
}

TEST(HealthyFamily, ALogWithoutRowsTellsNoCondition) {
  const MotionModel& model = rrp_motion_model();
  const auto bank = hypotheses_of(model.joints(), TorqueMeaning::commanded);
  EXPECT_TRUE(EpisodeDetector(model, bank, {}).slow_estimates().empty());
}

TEST(HealthyFamily, AnotherMassThanTheWorkPieceIsAFault) {
  MotionModel model = rrp_motion_model();
  model.work_pieces_kg = {1.0};
  const Log log = simulate(known_rrp(), rrp_run_with(FaultKind::payload_change, 3, kOnset_s, 2.5), 36).log;
  EXPECT_FALSE(watched(log, model).episodes.empty());
}

TEST(HealthyFamily, StampsThatWobbleAreTakenInStep) {
  Log log = simulate(known_rrp(), rrp_run(10.0), 37).log;
  for (int k = 7; k < log.rows(); k += 13) log.time[k] += k % 2 ? 0.002 : -0.002;
  MotionModel model = rrp_motion_model();
  model.steady_period_s = 0.01;
  EXPECT_TRUE(watched(log, model).episodes.empty());
}

/// dq as many controllers log it.
Log with_backward_differences(Log log) {
  for (std::size_t j = 0; j < log.q.size(); ++j)
    for (int k = log.rows() - 1; k > 0; --k)
      log.dq[j][k] = (log.q[j][k] - log.q[j][k - 1]) / (log.time[k] - log.time[k - 1]);
  return log;
}

TEST(HealthyFamily, AVelocityByDifferenceIsNoSecondMeasurementAndNoFault) {
  const Log log = with_backward_differences(simulate(known_rrp(), rrp_run(10.0), 38).log);
  MemorySource source(log);
  const LogNoise noise = survey_noise(source, rrp_motion_model());
  for (int j = 0; j < 3; ++j) EXPECT_TRUE(noise.dq_is_difference[j]);
  EXPECT_TRUE(watched(log).episodes.empty());
}

TEST(HealthyFamily, AFaultIsFoundWithAVelocityByDifference) {
  const Log log = with_backward_differences(
      simulate(known_rrp(), rrp_run_with(FaultKind::free_swinging, 2, kOnset_s, 0.0), 39).log);
  const std::vector<EpisodeEvidence> episodes = watched(log).episodes;
  ASSERT_FALSE(episodes.empty());
  EXPECT_GE(episodes.front().alarm_s, kOnset_s);
  EXPECT_LT(episodes.front().alarm_s, kOnset_s + 0.3);
}

TEST(HealthyFamily, AModelOfVelocitiesByDifferenceFollowsThePositionsAlone) {
  Log log = simulate(known_rrp(), rrp_run(5.0), 40).log;
  MotionModel model = rrp_motion_model();
  model.dq_is_difference = {1, 1, 1};
  for (std::vector<double>& dq : log.dq) dq.assign(dq.size(), 7.0);
  EXPECT_TRUE(watched(log, model).episodes.empty()) << "what dq says does not count";
}

TEST(HealthyFamily, WhatIsNormalIsTheDoubtOfTheSlowStates) {
  NormalRange normal;
  normal.friction = 0.5;
  normal.torque_constant = 0.0;
  normal.torque_offset = 0.04;
  const MotionModel& model = rrp_motion_model();
  for (const SlowState& slow : slow_states(model, normal)) {
    EXPECT_NE(slow.kind, SlowKind::torque_gain) << "it never differs";
    if (slow.kind == SlowKind::friction) {
      EXPECT_EQ(slow.day_std, 0.25);
    }
    if (slow.kind == SlowKind::torque_offset) {
      EXPECT_DOUBLE_EQ(slow.day_std, 0.02 * model.torque_scale[slow.joint]);
    }
  }
}

TEST(HealthyFamily, TheModelsFileKeepsAllOfIt) {
  MotionModel model = rrp_motion_model();
  model.work_pieces_kg = {0.7, 1.3};
  model.q_tail = {3.0, 3.0, 1e6};
  model.noise.compliance = {1e-5, 2e-5, 0.0};
  model.steady_period_s = 0.01;
  model.dq_is_difference = {0, 1, 0};
  nlohmann::json json;
  to_json(json, model);
  const MotionModel read = motion_model_from_json(json, known_rrp(), "test");
  ASSERT_EQ(read.slow.size(), model.slow.size());
  for (std::size_t s = 0; s < read.slow.size(); ++s) {
    EXPECT_EQ(read.slow[s].kind, model.slow[s].kind);
    EXPECT_EQ(read.slow[s].joint, model.slow[s].joint);
    EXPECT_EQ(read.slow[s].day_std, model.slow[s].day_std);
    EXPECT_EQ(read.slow[s].memory_s, model.slow[s].memory_s);
  }
  EXPECT_EQ(read.work_pieces_kg, model.work_pieces_kg);
  EXPECT_EQ(read.dq_is_difference, model.dq_is_difference);
  EXPECT_EQ(read.q_tail, model.q_tail);
  EXPECT_EQ(read.noise.compliance, model.noise.compliance);
  EXPECT_EQ(read.steady_period_s, model.steady_period_s);
  EXPECT_EQ(read.usual_noise.q, model.usual_noise.q);
}

}  // namespace
}  // namespace faultline
