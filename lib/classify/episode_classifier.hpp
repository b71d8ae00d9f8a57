// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "lib/fault/fault_kind.hpp"
#include "lib/neural/mlp.hpp"
#include "lib/neural/patterns.hpp"
#include "lib/neural/rbfn.hpp"

namespace faultline {

/// An episode with its true label, for training.
struct LabelledEpisode {
  std::vector<double> features;  ///< episode_features()
  FaultLabel label;
};

struct EpisodeClassifierOptions {
  int hidden = 24;  ///< units of the MLP
  double weight_decay = 3e-3;
  int map_side = 9;  ///< side of the square map on which the RBFN's centres lie
  double validation_share = 0.2;
  std::uint64_t seed = 1;
};

/// The two networks that classify an episode by its evidence (the paper's dual classification, figure 2). The
/// outputs are the labels; the confidence of an opinion is the label's probability (MLP) or its share of the
/// positive outputs (RBFN).
struct EpisodeClassifier {
  std::vector<FaultLabel> labels;  ///< of the outputs
  Scaler scaler;                   ///< of the features
  Mlp mlp;                         ///< softmax over the labels
  Rbfn rbfn;                       ///< one linear output for each label

  bool trained() const { return !labels.empty(); }
};

/// Throws Error(input) if the episodes have fewer than two labels.
EpisodeClassifier train_episode_classifier(std::span<const LabelledEpisode> episodes,
                                           const EpisodeClassifierOptions& options = {});
Opinions classify_episode(const EpisodeClassifier& classifier, const std::vector<double>& features);

void to_json(nlohmann::json& json, const EpisodeClassifier& classifier);
/// Throws Error(input) if the text is not valid; `where` names the file.
EpisodeClassifier episode_classifier_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace faultline
