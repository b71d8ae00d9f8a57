// SPDX-License-Identifier: MIT
#include "lib/classify/sample_classifier.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "lib/classify/fault_criterion.hpp"
#include "lib/core/error.hpp"
#include "lib/log/log_source.hpp"
#include "lib/residual/learn_residual.hpp"
#include "tests/support/bench_motion.hpp"

namespace faultline {
namespace {

constexpr double kNoise = 0.003;

const ResidualGenerator& generator() {
  static const ResidualGenerator learned = [] {
    MemorySource source(bench_log(bench_robot(), {.duration_s = 60.0, .noise = kNoise}));
    LogSource* logs[] = {&source};
    return learn_residual_generator(logs, bench_robot(), 0.0,
                                    {.hidden = {20}, .max_patterns = 800, .max_iterations = 25})
        .generator;
  }();
  return learned;
}

/// A run that frees `joint` at 4 s, or none for joint 0.
LabelledResiduals run(int joint, std::uint64_t seed) {
  const Log log = bench_log(
      bench_robot(), {.duration_s = 6.0, .noise = kNoise, .free_joint = joint, .fault_s = 4.0, .seed = seed});
  ResidualState state;
  LabelledResiduals labelled{.residuals = compute_residuals(generator(), log, state), .fault = {}};
  if (joint > 0) {
    labelled.fault = {FaultKind::free_swinging, Joint::numbered(joint)};
    labelled.onset_s = 4.0;
  }
  return labelled;
}

std::vector<LabelledResiduals> runs(int of_each, std::uint64_t seed) {
  std::vector<LabelledResiduals> all;
  for (int joint = 0; joint <= 3; ++joint)
    for (int i = 0; i < of_each; ++i) all.push_back(run(joint, seed++));
  return all;
}

const SampleClassifier& trained() {
  static const SampleClassifier classifier = train_sample_classifier(runs(25, 100), generator());
  return classifier;
}

TEST(SampleClassifier, HasAnOutputPerFaultAndALastOneForNoFault) {
  const SampleClassifier& classifier = trained();
  ASSERT_EQ(classifier.classes.size(), 4u);
  EXPECT_EQ(classifier.classes[1], (FaultLabel{FaultKind::free_swinging, 2_joint}));
  EXPECT_EQ(classifier.classes.back().kind, FaultKind::none);
  EXPECT_NEAR(classifier.prior.sum(), 1.0, 1e-12);
}

TEST(SampleClassifier, BothNetworksFindAFreeJointOnHeldOutRuns) {
  const SampleClassifier& classifier = trained();
  const OutputMeaning meaning{classifier.classes, classifier.prior};
  for (const bool use_mlp : {true, false}) {
    std::vector<LabelledOutputs> validation, test;
    for (auto* set : {&validation, &test})
      for (const LabelledResiduals& labelled :
           runs(set == &validation ? 20 : 8, set == &validation ? 500 : 900)) {
        const SampleOutputs outputs = classify_samples(classifier, labelled.residuals);
        set->push_back(
            {outputs.time, use_mlp ? outputs.mlp : outputs.rbfn, labelled.fault, labelled.onset_s});
      }
    for (const CriterionKind kind : {CriterionKind::consecutive, CriterionKind::log_odds}) {
      const CriterionOptions tuned = tune_criterion({.kind = kind}, meaning, validation).best;
      const CriterionScore score = score_criterion(tuned, meaning, test);
      EXPECT_GE(score.detected, 20) << "of 24";
      EXPECT_GE(score.right, 18) << "of 24";
      EXPECT_LE(score.false_alarms, 2) << "in 32 runs";
    }
  }
}

/// Mean squared errors of both networks over the samples of the runs, with targets 1 and 0.
Eigen::Vector2d errors_of(const SampleClassifier& classifier,
                          const std::vector<LabelledResiduals>& labelled) {
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  double count = 0.0;
  for (const LabelledResiduals& one : labelled) {
    const SampleOutputs outputs = classify_samples(classifier, one.residuals);
    for (int i = 0; i < outputs.time.size(); ++i) {
      if (!outputs.mlp.col(i).allFinite()) continue;
      const FaultLabel label = outputs.time[i] > one.onset_s ? one.fault : FaultLabel{};
      Eigen::VectorXd target(std::ssize(classifier.classes));
      for (std::size_t c = 0; c < classifier.classes.size(); ++c)
        target[c] = classifier.classes[c] == label ? 1.0 : 0.0;
      squares += Eigen::Vector2d((outputs.mlp.col(i) - target).squaredNorm(),
                                 (outputs.rbfn.col(i) - target).squaredNorm());
      count += static_cast<double>(target.size());
    }
  }
  return squares / count;
}

TEST(SampleClassifier, TrainsWithTheFeaturesOfThePaper) {
  SampleClassifierOptions options{.features = SampleFeatures::velocity, .output = OutputKind::linear};
  const SampleClassifier paper = train_sample_classifier(runs(6, 100), generator(), options);
  EXPECT_EQ(paper.mlp.inputs(), 3);
  const Eigen::Vector2d errors = errors_of(paper, runs(6, 100));
  EXPECT_LT(errors.maxCoeff(), 0.18);  // 4 outputs, one of them 1: always saying a quarter leaves 0.1875
}

TEST(SampleClassifier, FeaturesOfBothHypothesesIdentifyAFreeJoint) {
  const SampleClassifierOptions options{.features = SampleFeatures::hypotheses, .validate_every = 0};
  const SampleClassifier both = train_sample_classifier(runs(6, 100), generator(), options);
  EXPECT_EQ(both.mlp.inputs(), 9);
  const Eigen::Vector2d errors = errors_of(both, runs(6, 100));
  EXPECT_LT(errors[0], 0.05);
  EXPECT_LT(errors[1], 0.05);
}

TEST(SampleClassifier, TrainsByBackPropagation) {
  const SampleClassifierOptions options{
      .output = OutputKind::linear, .trainer = SampleTrainer::back_propagation, .max_iterations = 50};
  const SampleClassifier classifier = train_sample_classifier(runs(6, 100), generator(), options);
  EXPECT_LT(errors_of(classifier, runs(6, 100))[0], 0.15);
}

TEST(SampleClassifier, MissingResidualsGiveMissingOutputs) {
  LabelledResiduals labelled = run(0, 3);
  for (auto* matrix : {&labelled.residuals.velocity, &labelled.residuals.torque, &labelled.residuals.ratio})
    matrix->col(5).setConstant(std::numeric_limits<double>::quiet_NaN());
  const SampleOutputs outputs = classify_samples(trained(), labelled.residuals);
  EXPECT_TRUE(outputs.mlp.col(5).array().isNaN().all());
  EXPECT_TRUE(outputs.rbfn.col(5).array().isNaN().all());
  EXPECT_TRUE(outputs.average().col(6).allFinite());
}

TEST(SampleClassifier, JsonKeepsEveryBitAndChecksShapes) {
  const nlohmann::json json = trained();
  const SampleClassifier back = sample_classifier_from_json(nlohmann::json::parse(json.dump()), "model.json");
  const Residuals residuals = run(2, 77).residuals;
  const SampleOutputs before = classify_samples(trained(), residuals);
  const SampleOutputs after = classify_samples(back, residuals);
  EXPECT_TRUE(before.mlp.cwiseEqual(after.mlp).all());
  EXPECT_TRUE(before.rbfn.cwiseEqual(after.rbfn).all());
  nlohmann::json bad = json;
  bad["classes"].erase(0);
  EXPECT_THROW(sample_classifier_from_json(bad, "model.json"), Error);
  bad = json;
  bad["classes"][1]["fault"] = "gremlin";
  EXPECT_THROW(sample_classifier_from_json(bad, "model.json"), Error);
  bad = json;
  bad["features"] = "smell";
  EXPECT_THROW(sample_classifier_from_json(bad, "model.json"), Error);
}

TEST(SampleClassifier, NeedsFaultyAndFaultFreeSamples) {
  const std::vector<LabelledResiduals> healthy{run(0, 1), run(0, 2)};
  EXPECT_THROW(train_sample_classifier(healthy, generator()), Error);
  EXPECT_THROW(train_sample_classifier({}, generator()), Error);
}

}  // namespace
}  // namespace faultline
