// SPDX-License-Identifier: MIT
// What a finding of decide_episode() lists besides its name: alternatives, sizes, numbers.
#include <gtest/gtest.h>

#include "tests/diagnosis/hand_made_episode.hpp"

namespace faultline {
namespace {

FaultFinding decided(const Model& model, const EpisodeEvidence& episode) {
  return decide_episode({episode, {}}, model, empty_base(model));
}

Model agreed_on(const FaultLabel& label) { return hand_made_rrp({label, 0.9}, {label, 0.9}); }

std::string size_text(const FaultLabel& label, double size, double second_size = 0.0) {
  const Model model = agreed_on(label);
  const FaultFinding finding = decided(model, episode_of_fault(model, label, 100.0, size, second_size));
  const EvidenceItem* found = item(finding, "size");
  return found ? found->text : "";
}

TEST(CloseLabels, ThoseWithinTenNatsAreListed) {
  const Model model = agreed_on(kLocked2);
  EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  explain(episode, model, kStuck2, 90.1);
  explain(episode, model, kBias3, 89.9);
  const FaultFinding finding = decided(model, episode);
  EXPECT_NE(alternative(finding, kStuck2), nullptr);
  EXPECT_EQ(alternative(finding, kBias3), nullptr);
  EXPECT_EQ(alternative(finding, kLocked2), nullptr) << "a finding is no alternative to itself";
}

TEST(CloseLabels, AnUnknownDisturbanceIsNoAlternative) {
  const Model model = agreed_on(kLocked2);
  EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  explain(episode, model, {FaultKind::unknown, 2}, 100.5);
  EXPECT_TRUE(decided(model, episode).could_also_be.empty());
}

TEST(CloseLabels, NearnessIsToTheBestAndNotToTheFinding) {
  const Model model = agreed_on(kLocked2);
  EpisodeEvidence episode = episode_of_fault(model, kBias3, 150.0);
  explain(episode, model, kLocked2, 100.0);
  explain(episode, model, kStuck2, 95.0);
  const FaultFinding finding = decided(model, episode);
  EXPECT_EQ(finding.label, kLocked2);
  EXPECT_NE(alternative(finding, kBias3), nullptr);
  EXPECT_EQ(alternative(finding, kStuck2), nullptr);
}

/// A push on joint 1 that another hypothesis explains as one on all joints, by impulses a joint.
FaultFinding pushed(std::array<double, kMaxJoints> impulse, double everywhere_ratio) {
  const Model model = agreed_on(kPush1);
  EpisodeEvidence episode = episode_of_fault(model, kPush1);
  explain(episode, model, {FaultKind::collision, 0}, everywhere_ratio).impulse = impulse;
  return decided(model, episode);
}

TEST(PushOnAllJoints, ListsTheJointsItReached) {
  const FaultFinding finding = pushed({2.0, 0.6, -0.5}, 99.0);  // torque scales 20, 10, 40
  EXPECT_EQ(finding.label, kPush1);
  EXPECT_NE(alternative(finding, {FaultKind::collision, 2}), nullptr);
  EXPECT_EQ(alternative(finding, {FaultKind::collision, 3}), nullptr) << "1.25 % of its torque scale s";
}

TEST(PushOnAllJoints, IsMeasuredByTheUsualTorqueOfEachJoint) {
  const FaultFinding finding = pushed({2.0, 0.15, 1.0}, 99.0);
  EXPECT_EQ(alternative(finding, {FaultKind::collision, 2}), nullptr);
  EXPECT_NE(alternative(finding, {FaultKind::collision, 3}), nullptr);
}

TEST(PushOnAllJoints, SaysNothingWhenItExplainsTheLogWorse) {
  EXPECT_TRUE(pushed({2.0, 1.0, 4.0}, 89.0).could_also_be.empty());
}

TEST(PushOnAllJoints, TheBestOfItsDurationsCounts) {
  const Model model = agreed_on(kPush1);
  EpisodeEvidence episode = episode_of_fault(model, kPush1);
  explain(episode, model, {FaultKind::collision, 0}, 95.0).impulse = {2.0, 0.6, 0.0};
  for (std::size_t h = 0; h < model.bank.size(); ++h)
    if (is_everywhere(model.bank[h]) && model.bank[h].duration_s == 0.25) {
      episode.hypotheses[h].log_likelihood_ratio = 99.0;
      episode.hypotheses[h].impulse = {2.0, 0.0, 4.0};
    }
  const FaultFinding finding = decided(model, episode);
  EXPECT_EQ(alternative(finding, {FaultKind::collision, 2}), nullptr);
  EXPECT_NE(alternative(finding, {FaultKind::collision, 3}), nullptr);
}

TEST(PushOnAllJoints, IsOnlyTheBusinessOfCollisions) {
  const Model model = agreed_on(kLocked2);
  EpisodeEvidence episode = episode_of_fault(model, kLocked2);
  explain(episode, model, {FaultKind::collision, 0}, 85.0).impulse = {2.0, 2.0, 4.0};
  EXPECT_TRUE(decided(model, episode).could_also_be.empty());
}

TEST(SizeText, SaysHowLargeEachKindIsWithItsUnit) {
  EXPECT_EQ(size_text({FaultKind::torque_loss, 2}, 0.436), "about 44 % of the torque is lost");
  EXPECT_EQ(size_text({FaultKind::sensor_bias, 1}, 0.0321), "the position reads 0.0321 rad too much");
  EXPECT_EQ(size_text({FaultKind::sensor_bias, 3}, -0.0021), "the position reads 0.0021 m too little");
  EXPECT_EQ(size_text({FaultKind::sensor_drift, 2}, -0.05), "the position drifts by -0.05 rad/s");
  EXPECT_EQ(size_text({FaultKind::friction_increase, 1}, 2.0, 3.5),
            "friction rose by 3.5 N m plus 2 N m s/rad of speed");
  EXPECT_EQ(size_text({FaultKind::friction_increase, 3}, 20.0, 8.0),
            "friction rose by 8 N plus 20 N s/m of speed");
  EXPECT_EQ(size_text({FaultKind::payload_change, 3}, 0.75), "the load at the tip changed by +0.75 kg");
  EXPECT_EQ(size_text(kLocked2, 0.0), "") << "a lock has no size";
}

TEST(SizeText, IsThatOfTheBestHypothesisOfTheLabel) {
  const Model model = agreed_on(kDrift1);
  EpisodeEvidence episode = episode_of_fault(model, kDrift1, 80.0, 0.01);
  for (std::size_t h = 0; h < model.bank.size(); ++h)
    if (model.bank[h].label == kDrift1 && model.bank[h].form == HypothesisForm::drifting_velocity) {
      episode.hypotheses[h].log_likelihood_ratio = 100.0;
      episode.hypotheses[h].size[0] = 0.02;
      episode.best = static_cast<int>(h);
    }
  EXPECT_EQ(item(decided(model, episode), "size")->text, "the position drifts by +0.02 rad/s");
}

TEST(EvidenceLines, TellTheRatioAndTheThreshold) {
  Model model = agreed_on(kLocked2);
  model.evidence.threshold = 21.0;
  const FaultFinding finding = decided(model, episode_of_fault(model, kLocked2, 64.0));
  const EvidenceItem* ratio = item(finding, "log_likelihood_ratio");
  ASSERT_NE(ratio, nullptr);
  EXPECT_EQ(ratio->value, 64.0);
  EXPECT_EQ(ratio->unit, "nats");
  EXPECT_NE(ratio->text.find("alarm from 21 on"), std::string::npos) << ratio->text;
}

TEST(EvidenceLines, HaveAResidualOfEachJointThatHasOne) {
  const Model model = agreed_on(kLocked2);
  const FaultFinding finding = decide_episode(
      {episode_of_fault(model, kLocked2), residuals_of({1.1, kNaN, 20.0})}, model, empty_base(model));
  EXPECT_EQ(item(finding, "mlp_velocity_residual_1")->value, 1.1);
  EXPECT_EQ(item(finding, "mlp_velocity_residual_2"), nullptr);
  EXPECT_EQ(item(finding, "mlp_velocity_residual_3")->value, 20.0);
}

TEST(EpisodeFacts, KeepTheFeaturesUnderTheNamesOfTheCaseBase) {
  const Model model = agreed_on(kLocked2);
  const FaultFinding finding = decided(model, episode_of_fault(model, kLocked2, 64.0));
  EXPECT_EQ(finding.episode.evidence, 64.0);
  ASSERT_EQ(finding.episode.features.size(), features_of(model).size());
  EXPECT_EQ(finding.episode.features.front().first, "behind free_swinging 1");
}

}  // namespace
}  // namespace faultline
