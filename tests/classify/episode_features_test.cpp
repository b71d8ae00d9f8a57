// SPDX-License-Identifier: MIT
#include "lib/classify/episode_features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/fault/fault_catalogue.hpp"
#include "tests/support/hand_made_motion.hpp"

namespace faultline {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The labels of an RRP robot and a fault that nothing explains yet, from 1 to 1.5 s.
struct Example {
  UsualMotion model = hand_made_motion(known_rrp());
  std::vector<FaultLabel> labels = fault_labels(3, {3_joint}, false);
  ExplainedFault fault;

  /// Explains the fault by `label`.
  FaultClaim& of(const FaultLabel& label, double nats, const std::vector<double>& size = {}) {
    LabelScore score{.claim = {label.kind, label.joint, 1.0}, .nats = nats};
    score.claim.size = Eigen::Map<const Eigen::VectorXd>(size.data(), static_cast<Eigen::Index>(size.size()));
    fault.scores.push_back(score);
    return fault.scores.back().claim;
  }
  std::vector<LabelEvidence> by_label() const { return evidence_by_label(fault, 1.5, labels, model); }
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
  return episode_features(example.by_label(), 0.5, residuals_of(rms), 3);
}

/// A feature by its name.
double feature(const Example& example, const std::string& name, const std::vector<double>& rms) {
  const auto names = episode_feature_names(example.labels, 3);
  const auto values = features(example, rms);
  const auto at = std::find(names.begin(), names.end(), name);
  EXPECT_NE(at, names.end()) << name;
  return values.at(static_cast<std::size_t>(at - names.begin()));
}

TEST(EvidenceByLabel, HasEveryLabelOnce) {
  const auto all = Example().by_label();
  EXPECT_EQ(all.size(), 9u * 3u + 1u) << "nine kinds at three joints, and the payload at the tip";
  for (const LabelEvidence& a : all) {
    EXPECT_GT(a.label.joint, Joint());
    EXPECT_LT(a.log_likelihood_ratio, -300.0) << "nothing was judged";
  }
}

TEST(EvidenceByLabel, SizesAreInUnitsOfTheirScale) {
  Example example;
  const FaultLabel drift{FaultKind::sensor_drift, 2_joint}, push{FaultKind::collision, 2_joint},
      friction{FaultKind::friction_increase, 1_joint};
  example.of(drift, 50.0, {0.04});
  example.of(push, 40.0, {0.0, -8.0, 0.0, 0.0, 3.0, 0.0}).end_s = 1.1;
  example.of(friction, 30.0, {2.0, 3.0}).grows = true;
  EXPECT_EQ(example.entry(drift).log_likelihood_ratio, 50.0);
  EXPECT_NEAR(example.entry(drift).size[0], 0.5, 1e-12);
  const double impulse = 0.1 * (-8.0 + 3.0 * 2.0 / M_PI);  // steady, and half a sine
  EXPECT_NEAR(example.entry(push).size[0], impulse / (10.0 * 0.05), 1e-12);
  EXPECT_NEAR(example.entry(friction).size[1], 0.5, 1e-12) << "what it has grown to in half a second";
}

TEST(EpisodeFeatures, HaveOneUniqueNameEach) {
  const Example example;
  const std::vector<double> rms(3, 1.0);
  const auto names = episode_feature_names(example.labels, 3);
  EXPECT_EQ(features(example, rms).size(), names.size());
  for (const std::string& name : names) EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  EXPECT_EQ(names.size() - episode_feature_names(fault_labels(3, {3_joint}, true), 3).size(), 12u)
      << "behind and size of two kinds at three joints";
}

TEST(EpisodeFeatures, HoldTheEvidenceOfEachLabelBehindTheBest) {
  Example example;
  const std::vector<double> rms = {1.0, std::exp(2.0), kNaN};
  example.of({FaultKind::locked, 1_joint}, 60.0);
  example.of({FaultKind::locked, 2_joint}, 50.0);
  EXPECT_EQ(feature(example, "behind locked 1", rms), 0.0);
  EXPECT_NEAR(feature(example, "behind locked 2", rms), -std::log(11.0), 1e-12);
  EXPECT_NEAR(feature(example, "behind locked 3", rms), -std::log(301.0), 1e-12) << "out of the question";
  EXPECT_NEAR(feature(example, "strength", rms), std::log(61.0), 1e-12);
  EXPECT_NEAR(feature(example, "duration", rms), std::log(0.5), 1e-12);
  EXPECT_NEAR(feature(example, "mlp residual 2", rms), 2.0, 1e-12);
  EXPECT_EQ(feature(example, "mlp residual 3", rms), 0.0) << "not a number counts as healthy";
}

TEST(EpisodeFeatures, SizesShrinkWithTheEvidenceOfTheirLabel) {
  Example example;
  const std::vector<double> rms(3, 1.0);
  example.of({FaultKind::friction_increase, 1_joint}, 60.0, {2.0, 1.5});
  example.of({FaultKind::sensor_bias, 1_joint}, 40.0, {0.08});
  EXPECT_NEAR(feature(example, "size friction_increase 1", rms), std::tanh(1.0), 1e-12);
  EXPECT_NEAR(feature(example, "coulomb friction_increase 1", rms), std::tanh(0.5), 1e-12);
  EXPECT_NEAR(feature(example, "size sensor_bias 1", rms), std::exp(-1.0) * std::tanh(1.0), 1e-12);
}

TEST(EpisodeFeatures, StayFiniteForAnyEvidence) {
  Example example;
  example.of({FaultKind::sensor_bias, 1_joint}, 1e5, {1e9});
  example.of({FaultKind::sensor_bias, 2_joint}, -std::numeric_limits<double>::infinity(), {1e9});
  const std::vector<double> rms = {0.0, 1e9, kNaN};
  for (const double x : episode_features(example.by_label(), 0.0, residuals_of(rms), 3))
    EXPECT_TRUE(std::isfinite(x));
}

}  // namespace
}  // namespace faultline
