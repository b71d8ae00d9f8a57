// SPDX-License-Identifier: MIT
#include "lib/classify/episode_features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/hand_made_model.hpp"

namespace faultline {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The bank of an RRP robot and an episode that nothing explains yet.
struct Example {
  MotionModel model = hand_made_model(known_rrp());
  std::vector<Hypothesis> bank = hypotheses_of(3, TorqueMeaning::commanded);
  EpisodeEvidence episode;

  Example() {
    episode.onset_s = 1.0;
    episode.isolated_s = 1.5;
    episode.samples = 50;
    episode.hypotheses.resize(bank.size());
    for (HypothesisEvidence& h : episode.hypotheses) h.log_likelihood_ratio = -40.0;
  }
  /// The `nth` hypothesis of a label.
  HypothesisEvidence& of(const FaultLabel& label, int nth = 0) {
    std::size_t h = 0;
    for (; bank[h].label != label || nth-- > 0; ++h) continue;
    return episode.hypotheses[h];
  }
  std::vector<LabelEvidence> by_label() const { return evidence_by_label(episode, bank, model); }
  LabelEvidence entry(const FaultLabel& label) const {
    const auto all = by_label();
    return *std::find_if(all.begin(), all.end(), [&](const LabelEvidence& e) { return e.label == label; });
  }
};

std::vector<JointResidual> residuals_of(const std::vector<double>& velocity_rms) {
  std::vector<JointResidual> residuals(velocity_rms.size());
  for (std::size_t j = 0; j < velocity_rms.size(); ++j) residuals[j].velocity_rms = velocity_rms[j];
  return residuals;
}

std::vector<double> features(const Example& example, const std::vector<double>& rms) {
  return episode_features(example.episode, example.by_label(), residuals_of(rms), 3);
}

/// A feature by its name.
double feature(const Example& example, const std::string& name, const std::vector<double>& rms) {
  const auto names = episode_feature_names(example.bank, 3);
  const auto values = features(example, rms);
  const auto at = std::find(names.begin(), names.end(), name);
  EXPECT_NE(at, names.end()) << name;
  return values.at(static_cast<std::size_t>(at - names.begin()));
}

TEST(EvidenceByLabel, HasEveryLabelOnceWithoutMisreadRowsAndPushesOnAll) {
  const auto all = Example().by_label();
  EXPECT_EQ(all.size(), 10u * 3u + 1u) << "ten kinds at three joints, and the payload at the tip";
  for (const LabelEvidence& a : all) {
    EXPECT_GT(a.label.joint, 0);
    EXPECT_NE(a.label.kind, FaultKind::none);
    EXPECT_EQ(std::count_if(all.begin(), all.end(), [&](const auto& b) { return a.label == b.label; }), 1);
  }
}

TEST(EvidenceByLabel, TakesTheBestHypothesisOfALabelWithItsSize) {
  Example example;
  const FaultLabel drift{FaultKind::sensor_drift, 2};
  example.of(drift, 0) = {30.0, 1.0, {0.08}, {}, {}};
  example.of(drift, 1) = {50.0, 1.0, {-0.04}, {}, {}};
  EXPECT_EQ(example.entry(drift).log_likelihood_ratio, 50.0);
  EXPECT_NEAR(example.entry(drift).size[0], -0.5, 1e-12);
}

TEST(EvidenceByLabel, SizesAreInUnitsOfTheirPriors) {
  Example example;
  example.of({FaultKind::torque_loss, 1}).size = {0.7};
  example.of({FaultKind::sensor_bias, 3}).size = {0.004};
  example.of({FaultKind::friction_increase, 2}).size = {6.0, 2.0};
  example.of({FaultKind::payload_change, 3}).size = {2.5};
  example.of({FaultKind::unknown, 1}).size = {5.0};
  EXPECT_NEAR(example.entry({FaultKind::torque_loss, 1}).size[0], 0.7, 1e-12);
  EXPECT_NEAR(example.entry({FaultKind::sensor_bias, 3}).size[0], 0.5, 1e-12);
  EXPECT_NEAR(example.entry({FaultKind::friction_increase, 2}).size[0], 2.0, 1e-12);
  EXPECT_NEAR(example.entry({FaultKind::friction_increase, 2}).size[1], 0.5, 1e-12);
  EXPECT_NEAR(example.entry({FaultKind::payload_change, 3}).size[0], 2.0, 1e-12);
  EXPECT_NEAR(example.entry({FaultKind::unknown, 1}).size[0], 0.5, 1e-12);
}

TEST(EvidenceByLabel, APushOnAllJointsCountsForTheOneItPushesMost) {
  Example example;
  HypothesisEvidence& push = example.of({FaultKind::collision, 0});
  push.log_likelihood_ratio = 60.0;
  push.impulse = {1.0, -0.8, 1.0};  // torque scales 20, 10, 40
  EXPECT_EQ(example.entry({FaultKind::collision, 2}).log_likelihood_ratio, 60.0);
  EXPECT_NEAR(example.entry({FaultKind::collision, 2}).size[0], -0.8 / (10.0 * 0.05), 1e-12);
  EXPECT_EQ(example.entry({FaultKind::collision, 1}).log_likelihood_ratio, -40.0);
}

TEST(NamedBySize, OnlyALossOfNearlyAllTorqueIsAFreeJoint) {
  const FaultLabel loss{FaultKind::torque_loss, 2}, free{FaultKind::free_swinging, 2};
  const auto evidence = [&](double size) { return std::vector<LabelEvidence>{{loss, 50.0, size, 0.0}}; };
  EXPECT_EQ(named_by_size(loss, evidence(0.901)), free);
  EXPECT_EQ(named_by_size(loss, evidence(0.899)), loss);
  EXPECT_EQ(named_by_size({FaultKind::torque_loss, 1}, evidence(0.99)).kind, FaultKind::torque_loss)
      << "the size of another joint's loss";
  EXPECT_EQ(named_by_size({FaultKind::sensor_bias, 2}, {{{FaultKind::sensor_bias, 2}, 50.0, 3.0, 0.0}}).kind,
            FaultKind::sensor_bias);
}

TEST(Likeliest, IsTheLabelWithTheLargestRatio) {
  Example example;
  example.of({FaultKind::locked, 2}, 1).log_likelihood_ratio = 70.0;
  example.of({FaultKind::stuck_encoder, 2}).log_likelihood_ratio = 69.0;
  EXPECT_EQ(likeliest(example.by_label()).label, (FaultLabel{FaultKind::locked, 2}));
  EXPECT_EQ(likeliest(example.by_label()).log_likelihood_ratio, 70.0);
}

TEST(Likeliest, CallsALossOfNearlyAllTorqueAFreeJoint) {
  Example example;
  example.of({FaultKind::torque_loss, 3}) = {70.0, 1.0, {0.97}, {}, {}};
  EXPECT_EQ(likeliest(example.by_label()).label, (FaultLabel{FaultKind::free_swinging, 3}));
}

TEST(Likeliest, IsUnknownOnlyWhenEveryFaultExplainsLessThanHalf) {
  Example example;
  example.of({FaultKind::unknown, 2}).log_likelihood_ratio = 100.0;
  example.of({FaultKind::locked, 2}).log_likelihood_ratio = 49.0;
  EXPECT_EQ(likeliest(example.by_label()).label, (FaultLabel{FaultKind::unknown, 0}));
  example.of({FaultKind::locked, 2}).log_likelihood_ratio = 51.0;
  EXPECT_EQ(likeliest(example.by_label()).label, (FaultLabel{FaultKind::locked, 2}));
}

TEST(EpisodeFeatures, HaveANameEach) {
  const Example example;
  const std::vector<double> rms(3, 1.0);
  const auto names = episode_feature_names(example.bank, 3);
  EXPECT_EQ(features(example, rms).size(), names.size());
  for (const std::string& name : names) EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  const auto measured = hypotheses_of(3, TorqueMeaning::measured);
  EXPECT_EQ(names.size() - episode_feature_names(measured, 3).size(), 12u)
      << "behind and size of two kinds at three joints";
}

TEST(EpisodeFeatures, SayHowFarEachLabelIsBehind) {
  Example example;
  const std::vector<double> rms = {1.0, std::exp(2.0), kNaN};
  example.of({FaultKind::locked, 1}).log_likelihood_ratio = 60.0;
  example.of({FaultKind::locked, 2}).log_likelihood_ratio = 50.0;
  example.of({FaultKind::locked, 3}).log_likelihood_ratio = -1e6;
  example.of({FaultKind::locked, 3}, 1).log_likelihood_ratio = -1e6;
  EXPECT_EQ(feature(example, "behind locked 1", rms), 0.0);
  EXPECT_NEAR(feature(example, "behind locked 2", rms), -std::log(11.0), 1e-12);
  EXPECT_NEAR(feature(example, "behind locked 3", rms), -std::log(301.0), 1e-12) << "out of the question";
  EXPECT_NEAR(feature(example, "strength", rms), std::log(61.0), 1e-12);
  EXPECT_NEAR(feature(example, "samples", rms), std::log(50.0), 1e-12);
  EXPECT_NEAR(feature(example, "duration", rms), std::log(0.5), 1e-12);
  EXPECT_NEAR(feature(example, "mlp residual 2", rms), 2.0, 1e-12);
  EXPECT_EQ(feature(example, "mlp residual 3", rms), 0.0) << "not a number counts as healthy";
}

TEST(EpisodeFeatures, SizesFadeWithTheLabelsEvidence) {
  Example example;
  const std::vector<double> rms(3, 1.0);
  example.of({FaultKind::friction_increase, 1}) = {60.0, 1.0, {2.0, 1.5}, {}, {}};
  example.of({FaultKind::sensor_bias, 1}) = {40.0, 1.0, {0.08}, {}, {}};
  EXPECT_NEAR(feature(example, "size friction_increase 1", rms), std::tanh(1.0), 1e-12);
  EXPECT_NEAR(feature(example, "coulomb friction_increase 1", rms), std::tanh(0.5), 1e-12);
  EXPECT_NEAR(feature(example, "size sensor_bias 1", rms), std::exp(-1.0) * std::tanh(1.0), 1e-12);
}

TEST(EpisodeFeatures, StayFiniteWhateverTheEvidence) {
  Example example;
  for (HypothesisEvidence& h : example.episode.hypotheses)
    h.log_likelihood_ratio = -std::numeric_limits<double>::infinity();
  example.of({FaultKind::sensor_bias, 1}) = {1e5, 1.0, {1e9}, {}, {}};
  example.episode.samples = 0;
  example.episode.isolated_s = example.episode.onset_s;
  const std::vector<double> rms = {0.0, 1e9, kNaN};
  for (const double x : features(example, rms)) EXPECT_TRUE(std::isfinite(x));
}

}  // namespace
}  // namespace faultline
