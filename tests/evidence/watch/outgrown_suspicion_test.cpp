// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/classify/episode_features.hpp"
#include "lib/evidence/survey/survey_log.hpp"
#include "lib/evidence/watch/episode_detector.hpp"
#include "lib/fault/label_text.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

/// A small push wakes the bank and raises no alarm; while it is looked into, something grave begins.
Log knocked_before(FaultKind kind, double size) {
  SimulationSpec spec = rrp_run_with(kind, 2, 5.103, size);
  spec.faults.push_back({FaultKind::collision, 1, 4.903, 4.953, 2.2, 0.0});
  return simulate(known_rrp(), spec, 94).log;
}

TEST(OutgrownSuspicion, AFaultThatBeginsDuringASmallSuspicionIsToldFromItsOwnOnset) {
  const auto bank = hypotheses_of(3, TorqueMeaning::commanded);
  const MotionModel& model = rrp_motion_model();
  EvidenceOptions cautious;
  cautious.threshold = 400.0;  // the push stays a suspicion
  const std::pair<FaultKind, double> faults[] = {{FaultKind::stuck_encoder, 0.0},
                                                 {FaultKind::sensor_bias, 0.05}};
  for (const auto& [kind, size] : faults) {
    MemorySource source(knocked_before(kind, size));
    EpisodeDetector detector(model, bank, cautious, survey_noise(source, model));
    for (Log segment; source.next(segment);) detector.take(segment);
    detector.finish();
    ASSERT_FALSE(detector.episodes().empty()) << to_string(kind);
    const EpisodeEvidence& episode = detector.episodes().front();
    const FaultLabel named = likeliest(evidence_by_label(episode, bank, model)).label;
    EXPECT_EQ(label_text(named), label_text({kind, 2}));
    EXPECT_NEAR(episode.onset_s, 5.103, 0.011) << to_string(kind);
    EXPECT_LT(episode.alarm_s, 5.2) << to_string(kind);
  }
}

}  // namespace
}  // namespace faultline
