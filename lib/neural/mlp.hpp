// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "lib/neural/patterns.hpp"

namespace faultline {

/// Output function of the last layer's weighted sums a, and the loss of a pattern that belongs to it
/// (dloss/da is output - target in each case).
enum class OutputKind {
  linear,    ///< y = a; half the squared error
  logistic,  ///< y = 1 / (1 + exp(-a)), each output independent; cross-entropy
  softmax,   ///< y = exp(a) / sum exp(a), probabilities of exclusive classes; cross-entropy
};
const char* to_string(OutputKind kind);

struct MlpLayer {
  Eigen::MatrixXd weights;  ///< outputs x inputs
  Eigen::VectorXd bias;
};

/// Multi-layer perceptron with tanh in every layer but the last. The paper's has 9-49-6 units and a linear
/// output.
struct Mlp {
  std::vector<MlpLayer> layers;
  OutputKind output = OutputKind::linear;

  int inputs() const { return layers.empty() ? 0 : static_cast<int>(layers.front().weights.cols()); }
  int outputs() const { return layers.empty() ? 0 : static_cast<int>(layers.back().weights.rows()); }
  int parameters() const;
};

/// Returns a random start for training: uniform weights of variance 2 / (fan in + fan out) (Glorot and Bengio
/// 2010), small random biases. `sizes` = inputs, hidden..., outputs. Throws Error(usage) for fewer than two
/// layers or for empty layers.
Mlp make_mlp(const std::vector<int>& sizes, OutputKind output = OutputKind::linear, std::uint64_t seed = 1);

/// Outputs (outputs x samples) for inputs (inputs x samples). The result of a sample depends on its own
/// inputs only, to the last bit, for any number of samples. NaN inputs give NaN outputs.
Eigen::MatrixXd forward(const Mlp& mlp, const Eigen::Ref<const Eigen::MatrixXd>& inputs);

/// All weights (column by column) and then biases, layer after layer.
Eigen::VectorXd parameters_of(const Mlp& mlp);
void set_parameters(Mlp& mlp, const Eigen::VectorXd& parameters);

/// Mean loss over the patterns + weight_decay / 2 * sum of squared weights (not biases), and its gradient in
/// the order of parameters_of(), by back-propagation.
struct LossGradient {
  double loss = 0.0;
  Eigen::VectorXd gradient;
};
LossGradient loss_gradient(const Mlp& mlp, const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                           const Eigen::Ref<const Eigen::MatrixXd>& targets, double weight_decay = 0.0);

/// Mean squared error over all patterns and outputs.
double mean_squared_error(const Mlp& mlp, const Patterns& patterns);

/// Writes and reads without loss of a bit. Throws Error(input) naming the layer if the shapes do not fit or a
/// number is missing; `where` names the file.
void to_json(nlohmann::json& json, const Mlp& mlp);
Mlp mlp_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace faultline
