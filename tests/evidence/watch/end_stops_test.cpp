// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/classify/episode_features.hpp"
#include "lib/evidence/learn/learn_motion_model.hpp"
#include "lib/evidence/survey/survey_log.hpp"
#include "lib/evidence/watch/episode_detector.hpp"
#include "lib/fault/label_text.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

constexpr double kOnset_s = 2.503;

/// At 1 kHz, where a joint takes some rows to be stopped.
SimulationSpec fast_run(double duration_s) {
  SimulationSpec spec = rrp_run(duration_s);
  spec.sample_period_s = spec.control_period_s = 0.001;
  spec.motion.low = {-2.0, -2.0, -0.25};
  spec.motion.high = {2.0, 2.0, 0.0};
  return spec;
}

const MotionModel& fast_model() {
  static const MotionModel model = [] {
    std::vector<MemorySource> days;
    for (const std::uint64_t seed : {11, 12})
      days.emplace_back(simulate(known_rrp(), fast_run(6.0), seed).log);
    std::vector<LogSource*> logs;
    for (MemorySource& day : days) logs.push_back(&day);
    IdentifiedMotion identified;
    identified.chain = known_rrp().chain;
    identified.torque_is_held = true;
    identified.q_std = {1e-4, 1e-4, 2e-5};
    identified.dq_std = {5e-3, 5e-3, 1e-3};
    return learn_motion_model(logs, identified, {});
  }();
  return model;
}

TEST(EndStops, AFreedJointThatFellOnItsStopSwingsFreelyToTheEnd) {
  const auto bank = hypotheses_of(3, TorqueMeaning::commanded);
  for (const std::uint64_t seed : {61, 62}) {
    SimulationSpec spec = fast_run(7.0);
    spec.faults = {{FaultKind::free_swinging, 3, kOnset_s, 1e9, 0.0, 0.0}};
    spec.stops.low = {-9.0, -9.0, -0.35};
    spec.stops.high = {9.0, 9.0, 0.1};
    const Log log = simulate(known_rrp(), spec, seed).log;
    MemorySource source(log);
    EpisodeDetector detector(fast_model(), bank, {}, survey_noise(source, fast_model()));
    for (Log segment; source.next(segment);) detector.take(segment);
    detector.finish();
    ASSERT_EQ(detector.episodes().size(), 1u) << seed;
    const EpisodeEvidence& episode = detector.episodes().front();
    const FaultLabel named = likeliest(evidence_by_label(episode, bank, fast_model())).label;
    EXPECT_EQ(label_text(named), label_text({FaultKind::free_swinging, 3})) << seed;
    EXPECT_GT(episode.end_s, log.time.back() - 0.1) << seed;
  }
}

}  // namespace
}  // namespace faultline
