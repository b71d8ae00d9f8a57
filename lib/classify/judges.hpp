// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "lib/fault/fault_kind.hpp"
#include "lib/neural/mlp.hpp"
#include "lib/neural/rbfn.hpp"
#include "lib/neural/scaler.hpp"

namespace faultline {

/// An episode with its truth, to learn from.
struct LabelledEpisode {
  std::vector<double> features;  ///< episode_features()
  FaultLabel label;
};

struct JudgeOptions {
  int hidden = 24;  ///< units of the MLP
  double weight_decay = 3e-3;
  int map_side = 9;  ///< the RBFN's centres lie on a square map of this side
  double validation_share = 0.2;
  std::uint64_t seed = 1;
};

/// The two networks that judge the evidence of an episode (the paper's dual classification, figure 2).
struct Judges {
  std::vector<FaultLabel> labels;  ///< of the outputs
  Scaler scaler;                   ///< of the features
  Mlp mlp;                         ///< softmax over the labels
  Rbfn rbfn;                       ///< one linear output a label

  bool trained() const { return !labels.empty(); }
};

/// A network's word: the label of its largest output.
struct NetworkOpinion {
  FaultLabel label;
  double confidence =
      0.0;  ///< 0 to 1: the label's probability (MLP), its share of the positive outputs (RBFN)
};
struct JudgeOpinions {
  NetworkOpinion mlp;
  NetworkOpinion rbfn;
};

/// Throws Error(input) when there are fewer than two labels to tell apart.
Judges train_judges(std::span<const LabelledEpisode> episodes, const JudgeOptions& options = {});
JudgeOpinions judge(const Judges& judges, const std::vector<double>& features);

void to_json(nlohmann::json& json, const Judges& judges);
/// Throws Error(input); `where` names the file.
Judges judges_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace faultline
