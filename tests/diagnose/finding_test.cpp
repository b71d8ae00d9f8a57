// SPDX-License-Identifier: MIT
// What a finding of decide_episode() lists besides its name: alternatives, sizes, numbers.
#include "lib/diagnose/finding.hpp"

#include <gtest/gtest.h>

#include "tests/diagnose/hand_made_episode.hpp"

namespace faultline {
namespace {

FaultFinding decided(const Model& model, const MonitoredEpisode& episode) {
  return decide_episode(episode, model, empty_base(model));
}

Model agreed_on(const FaultLabel& label) { return hand_made_rrp({label, 0.9}, {label, 0.9}); }

std::string size_text(const FaultLabel& label, double size, double second_size = 0.0) {
  const Model model = agreed_on(label);
  const FaultFinding finding = decided(model, episode_of_fault(label, 100.0, size, second_size));
  const EvidenceItem* found = item(finding, "size");
  return found ? found->text : "";
}

TEST(Alternatives, ListTheFaultsThatExplainTheLogAlmostAsWell) {
  const Model model = agreed_on(kLocked2);
  MonitoredEpisode episode = episode_of_fault(kLocked2);
  explain_alike(episode, kStuck2, 97.0);
  explain(episode, kBias3, 40.0);
  const FaultFinding finding = decided(model, episode);
  EXPECT_NE(alternative(finding, kStuck2), nullptr);
  EXPECT_EQ(alternative(finding, kBias3), nullptr);
  EXPECT_EQ(alternative(finding, kLocked2), nullptr) << "a finding is no alternative to itself";
}

/// A push of a tenth of a second on joint 1 that reaches all joints, by torques.
FaultFinding pushed(const Eigen::Vector3d& torque) {
  const Model model = agreed_on(kPush1);
  MonitoredEpisode episode = episode_of_fault(kPush1);
  episode.fault.claim.end_s = 2.1;
  episode.fault.claim.size = torque;
  return decided(model, episode);
}

TEST(PushOnAllJoints, ListsTheJointsThatGotALargeShareOfTheirUsualTorque) {
  const FaultFinding first = pushed({20.0, 6.0, -5.0});  // largest torques 20, 10, 40
  EXPECT_EQ(first.label, kPush1);
  EXPECT_NE(alternative(first, {FaultKind::collision, 2_joint}), nullptr);
  EXPECT_EQ(alternative(first, {FaultKind::collision, 3_joint}), nullptr)
      << "an eighth of its largest torque";
  const FaultFinding second = pushed({20.0, 1.5, 10.0});
  EXPECT_EQ(alternative(second, {FaultKind::collision, 2_joint}), nullptr);
  EXPECT_NE(alternative(second, {FaultKind::collision, 3_joint}), nullptr);
}

TEST(SizeText, StatesTheSizeOfEachKindWithItsUnit) {
  EXPECT_EQ(size_text({FaultKind::torque_loss, 2_joint}, 0.436), "about 44 % of the torque is lost");
  EXPECT_EQ(size_text({FaultKind::sensor_bias, 1_joint}, 0.0321), "the position reads 0.0321 rad too much");
  EXPECT_EQ(size_text({FaultKind::sensor_bias, 3_joint}, -0.0021), "the position reads 0.0021 m too little");
  EXPECT_EQ(size_text({FaultKind::sensor_drift, 2_joint}, -0.05), "the position drifts by -0.05 rad/s");
  EXPECT_EQ(size_text({FaultKind::friction_increase, 1_joint}, 2.0, 3.5),
            "dry friction changed by +3.5 N m, viscous friction by +2 N m s/rad");
  EXPECT_EQ(size_text({FaultKind::friction_increase, 3_joint}, 20.0, 8.0),
            "dry friction changed by +8 N, viscous friction by +20 N s/m");
  EXPECT_EQ(size_text({FaultKind::payload_change, 3_joint}, 0.75),
            "the load at the end of link 3 changed by +0.75 kg");
  EXPECT_EQ(size_text(kLocked2, 0.0), "") << "a lock has no size";
}

TEST(SizeText, StatesTheFinalSizeOfAFaultThatGrows) {
  const FaultLabel friction{FaultKind::friction_increase, 1_joint};
  MonitoredEpisode episode = episode_of_fault(friction, 100.0, 1.0, 2.0);
  episode.fault.scores.front().claim.grows = true;
  EXPECT_EQ(item(decided(agreed_on(friction), episode), "size")->text,
            "dry friction changed by +4 N m, viscous friction by +2 N m s/rad");
}

TEST(EvidenceLines, StateTheEvidenceAndTheThreshold) {
  const FaultFinding finding = decided(agreed_on(kLocked2), episode_of_fault(kLocked2, 64.0));
  const EvidenceItem* ratio = item(finding, "log_likelihood_ratio");
  ASSERT_NE(ratio, nullptr);
  EXPECT_EQ(ratio->value, 64.0);
  EXPECT_EQ(ratio->unit, "nats");
  EXPECT_NE(ratio->text.find("alarm from 21 on"), std::string::npos) << ratio->text;
}

TEST(EvidenceLines, HaveAResidualOfEachJointThatHasOne) {
  const Model model = agreed_on(kLocked2);
  MonitoredEpisode episode = episode_of_fault(kLocked2);
  episode.residuals = residuals_of({1.1, kNaN, 20.0});
  const FaultFinding finding = decided(model, episode);
  EXPECT_EQ(item(finding, "mlp_velocity_residual_1")->value, 1.1);
  EXPECT_EQ(item(finding, "mlp_velocity_residual_2"), nullptr);
  EXPECT_EQ(item(finding, "mlp_velocity_residual_3")->value, 20.0);
}

TEST(EpisodeFacts, KeepTheFeaturesUnderTheNamesOfTheCaseBase) {
  const Model model = agreed_on(kLocked2);
  const FaultFinding finding = decided(model, episode_of_fault(kLocked2, 64.0));
  EXPECT_EQ(finding.episode.evidence, 64.0);
  ASSERT_EQ(finding.episode.features.size(), features_of(model).size());
  EXPECT_EQ(finding.episode.features.front().first, "behind free_swinging 1");
}

TEST(LastingFriction, IsReportedIfItsWholeIntervalExceedsTwiceTheNormalRange) {
  const auto friction = [](double value, double std) {
    return lasting_friction({{DayEffectKind::friction, 2_joint, value, std, 0.1}}).size();
  };
  EXPECT_EQ(friction(0.5, 0.01), 1u) << "the normal range is 20 %";
  EXPECT_EQ(friction(0.5, 0.2), 0u) << "the log hardly determines it";
  EXPECT_EQ(friction(0.35, 0.01), 0u);
  EXPECT_EQ(friction(-0.9, 0.01), 0u) << "less friction is no fault";
}

TEST(LastingFriction, IsNotReportedForOtherEffectsOfTheDay) {
  EXPECT_TRUE(lasting_friction({{DayEffectKind::torque_gain, 1_joint, 5.0, 0.01, 0.1}}).empty());
}

}  // namespace
}  // namespace faultline
