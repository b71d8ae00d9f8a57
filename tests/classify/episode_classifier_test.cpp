// SPDX-License-Identifier: MIT
#include "lib/classify/episode_classifier.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/random.hpp"

namespace faultline {
namespace {

const std::vector<FaultLabel> kLabels = {
    {FaultKind::locked, 1_joint}, {FaultKind::locked, 2_joint}, {FaultKind::sensor_bias, 1_joint}};

/// Each fault has a place of its own in the first two features; the third is noise.
LabelledEpisode draw_episode(std::size_t which, Random& random) {
  static constexpr double kPlace[3][2] = {{0.0, 0.0}, {3.0, 0.0}, {0.0, 300.0}};
  const auto [x, y] = kPlace[which];
  return {{x + 0.3 * random.normal(), y + 30.0 * random.normal(), random.normal()}, kLabels[which]};
}

std::vector<LabelledEpisode> draw_episodes(int each, std::uint64_t seed) {
  Random random(seed);
  std::vector<LabelledEpisode> episodes;
  for (int i = 0; i < each; ++i)
    for (const std::size_t which : {2, 0, 1}) episodes.push_back(draw_episode(which, random));
  return episodes;
}

const EpisodeClassifier& trained() {
  static const EpisodeClassifier classifier = train_episode_classifier(draw_episodes(40, 1));
  return classifier;
}

bool same(const Opinion& a, const Opinion& b) { return a.label == b.label && a.confidence == b.confidence; }

/// Points near the training episodes and far out.
std::vector<std::vector<double>> probes() {
  std::vector<std::vector<double>> out;
  for (const LabelledEpisode& episode : draw_episodes(10, 5)) out.push_back(episode.features);
  for (const double far : {-1e4, -50.0, 50.0, 1e4}) out.push_back({far, 10.0 * far, -far});
  return out;
}

nlohmann::json json_of(const EpisodeClassifier& classifier) {
  nlohmann::json json;
  to_json(json, classifier);
  return json;
}

TEST(EpisodeClassifier, ClassifiesHeldOutEpisodes) {
  int mlp = 0, rbfn = 0;
  const auto fresh = draw_episodes(50, 2);
  for (const LabelledEpisode& episode : fresh) {
    const Opinions opinions = classify_episode(trained(), episode.features);
    mlp += opinions.mlp.label == episode.label;
    rbfn += opinions.rbfn.label == episode.label;
  }
  EXPECT_GE(mlp, 147) << "of 150 that are five standard deviations from each other's border";
  EXPECT_GE(rbfn, 147);
}

TEST(EpisodeClassifier, IsMoreConfidentInTheMiddleOfAFaultThanBetweenTwo) {
  const Opinions middle = classify_episode(trained(), {0.0, 0.0, 0.0}),
                 between = classify_episode(trained(), {1.5, 0.0, 0.0});
  EXPECT_GT(middle.mlp.confidence, 0.9);
  EXPECT_GT(middle.rbfn.confidence, 0.75);
  EXPECT_LT(between.mlp.confidence, middle.mlp.confidence);
  EXPECT_LT(between.rbfn.confidence, middle.rbfn.confidence);
}

TEST(EpisodeClassifier, ConfidenceLiesBetweenZeroAndOne) {
  for (const auto& features : probes()) {
    const Opinions opinions = classify_episode(trained(), features);
    for (const Opinion& opinion : {opinions.mlp, opinions.rbfn}) {
      EXPECT_GE(opinion.confidence, 0.0);
      EXPECT_LE(opinion.confidence, 1.0);
    }
    EXPECT_GE(opinions.mlp.confidence, 1.0 / 3.0) << "the largest of three probabilities";
  }
}

TEST(EpisodeClassifier, LabelsAreSortedWhateverTheOrderOfTheEpisodes) {
  EXPECT_EQ(trained().labels, kLabels);
  EXPECT_TRUE(trained().trained());
  EXPECT_FALSE(EpisodeClassifier{}.trained());
}

TEST(EpisodeClassifier, TheOrderOfTheFeaturesMatters) {
  const std::vector<double> second = {3.0, 0.0, 0.0}, moved = {0.0, 0.0, 3.0};
  const Opinions there = classify_episode(trained(), second), elsewhere = classify_episode(trained(), moved);
  EXPECT_EQ(there.mlp.label, kLabels[1]);
  EXPECT_EQ(there.rbfn.label, kLabels[1]);
  EXPECT_EQ(elsewhere.mlp.label, kLabels[0]);
  EXPECT_EQ(elsewhere.rbfn.label, kLabels[0]);
}

TEST(EpisodeClassifier, JsonKeepsEveryBitOfTheOpinions) {
  const std::string text = json_of(trained()).dump();
  const EpisodeClassifier read = episode_classifier_from_json(nlohmann::json::parse(text), "model.json");
  EXPECT_EQ(read.labels, trained().labels);
  for (const auto& features : probes()) {
    const Opinions a = classify_episode(trained(), features), b = classify_episode(read, features);
    EXPECT_TRUE(same(a.mlp, b.mlp));
    EXPECT_TRUE(same(a.rbfn, b.rbfn));
  }
}

TEST(EpisodeClassifier, TheSameEpisodesAndSeedGiveTheSameClassifier) {
  const auto episodes = draw_episodes(15, 3);
  EXPECT_EQ(json_of(train_episode_classifier(episodes)), json_of(train_episode_classifier(episodes)));
  EpisodeClassifierOptions other;
  other.seed = 2;
  EXPECT_NE(json_of(train_episode_classifier(episodes)), json_of(train_episode_classifier(episodes, other)));
}

TEST(EpisodeClassifier, FewerThanTwoLabelsAreRefused) {
  std::vector<LabelledEpisode> one = {{{1.0, 2.0}, kLabels[0]}, {{1.5, 2.5}, kLabels[0]}};
  EXPECT_THROW(train_episode_classifier({}), Error);
  try {
    train_episode_classifier(one);
    FAIL() << "one label was accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("show 1 kinds of fault; at least two"), std::string::npos)
        << error.what();
  }
}

TEST(EpisodeClassifierJson, AMissingPartIsRefusedWithTheFilesName) {
  for (const char* part : {"labels", "scaler", "mlp", "rbfn"}) {
    nlohmann::json json = json_of(trained());
    json.erase(part);
    try {
      episode_classifier_from_json(json, "model.json");
      FAIL() << part;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("model.json"), std::string::npos) << error.what();
    }
  }
}

TEST(EpisodeClassifierJson, NetworksThatDoNotFitTheLabelsAreRefused) {
  nlohmann::json json = json_of(trained());
  json["labels"].push_back({"collision", 1});
  EXPECT_THROW(episode_classifier_from_json(json, "model.json"), Error);
}

TEST(EpisodeClassifierJson, NetworksThatDoNotFitTheFeaturesAreRefused) {
  EpisodeClassifier classifier = trained();
  classifier.scaler = {Eigen::VectorXd::Zero(4), Eigen::VectorXd::Ones(4)};
  EXPECT_THROW(episode_classifier_from_json(json_of(classifier), "model.json"), Error);
}

TEST(EpisodeClassifierJson, AnUnknownFaultIsRefused) {
  nlohmann::json json = json_of(trained());
  json["labels"][0][0] = "haunted";
  EXPECT_THROW(episode_classifier_from_json(json, "model.json"), Error);
}

}  // namespace
}  // namespace faultline
