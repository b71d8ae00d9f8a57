// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/classify/episode_features.hpp"
#include "lib/evidence/survey/survey_log.hpp"
#include "lib/evidence/watch/episode_detector.hpp"
#include "lib/fault/label_text.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

constexpr double kOnset_s = 5.003;

EpisodeEvidence only_episode(const SimulationSpec& spec, const std::vector<Hypothesis>& bank) {
  const MotionModel& model = rrp_motion_model();
  MemorySource source(simulate(known_rrp(), spec, 91).log);
  EpisodeDetector detector(model, bank, {}, survey_noise(source, model));
  for (Log segment; source.next(segment);) detector.take(segment);
  detector.finish();
  EXPECT_EQ(detector.episodes().size(), 1u);
  return detector.episodes().empty() ? EpisodeEvidence{} : detector.episodes().front();
}

TEST(TorqueSensor, AnOffsetIsNamedWithItsSizeAtEachJoint) {
  const auto bank = hypotheses_of(3, TorqueMeaning::commanded);
  const double sizes[] = {8.0, -4.0, 15.0};
  for (int joint = 1; joint <= 3; ++joint) {
    const double size = sizes[joint - 1];
    const EpisodeEvidence episode =
        only_episode(rrp_run_with(FaultKind::torque_sensor_error, joint, kOnset_s, size), bank);
    ASSERT_FALSE(episode.hypotheses.empty());
    const FaultLabel named = likeliest(evidence_by_label(episode, bank, rrp_motion_model())).label;
    EXPECT_EQ(label_text(named), label_text({FaultKind::torque_sensor_error, joint}));
    EXPECT_NEAR(episode.onset_s, kOnset_s, 0.05);
    for (std::size_t h = 0; h < bank.size(); ++h) {
      if (bank[h].label != named) continue;
      EXPECT_NEAR(episode.hypotheses[h].size[0], size, 0.1 * std::abs(size));
    }
  }
}

TEST(TorqueSensor, AnOffsetThatEndsIsOverThen) {
  const auto bank = hypotheses_of(3, TorqueMeaning::commanded);
  SimulationSpec spec = rrp_run_with(FaultKind::torque_sensor_error, 1, kOnset_s, 8.0, 2.5);
  spec.duration_s = kOnset_s + 6.0;
  EXPECT_NEAR(only_episode(spec, bank).end_s, kOnset_s + 2.5, 0.1);
}

}  // namespace
}  // namespace faultline
