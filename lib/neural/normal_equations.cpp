// SPDX-License-Identifier: MIT
#include "lib/neural/normal_equations.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/neural/kernels.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using LowerCholesky = Eigen::LLT<MatrixXd, Eigen::Lower>;

/// Patterns processed at once, which bounds the memory.
constexpr Index kChunk = 512;

/// Values of the hidden units, with a last row of ones for the bias of the outputs.
MatrixXd hidden_units(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs) {
  const Index hidden = mlp.layers[1].weights.cols();
  MatrixXd units(hidden + 1, inputs.cols());
  units.topRows(hidden) = forward(Mlp{{mlp.layers[0]}, OutputKind::linear}, inputs);
  for (Index n = 0; n < units.cols(); ++n)
    for (Index k = 0; k < hidden; ++k) units(k, n) = elementary::tanh(units(k, n));
  units.row(hidden).setOnes();
  return units;
}

/// Factor of the normal matrix of an output's weights and bias. A ridge far below the matrix's own size keeps
/// it definite if hidden units are copies of each other.
LowerCholesky output_factor(MatrixXd own, double weight_decay) {
  constexpr double kRidge = 1e-13;  // share of the trace
  own.diagonal().array() += kRidge * own.trace();
  own.diagonal().head(own.rows() - 1).array() += weight_decay;
  return LowerCholesky(own);
}

}  // namespace

MlpLayer fitted_outputs(const Mlp& mlp, const Patterns& patterns, double weight_decay) {
  const Index hidden = mlp.layers[1].weights.cols();
  const double count = static_cast<double>(patterns.inputs.cols());
  const MatrixXd units = hidden_units(mlp, patterns.inputs);
  const LowerCholesky factor = output_factor(units * units.transpose() / count, weight_decay);
  const MatrixXd weights = factor.solve(units * patterns.targets.transpose() / count);
  return {weights.topRows(hidden).transpose(), weights.row(hidden).transpose()};
}

/// With z_(i,k) = (1 - h_k^2) x_i and x, h extended by 1 for the biases, J has W2(o,k) z_(i,k) for the first
/// layer and h_k for output o's own weights, so one Gram matrix of [z; h] serves all outputs: its blocks are
/// G, C and H H^T. Returns the matrix of the hidden layer with the outputs eliminated,
/// (G - C^T (H H^T)^-1 C) times W2^T W2 by hidden units, plus the weight decay.
MatrixXd hidden_layer_matrix(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs, double weight_decay) {
  const Index hidden = mlp.layers[1].weights.cols(), ins = inputs.rows() + 1, first = hidden * ins;
  const Index padded = (first + hidden + kGramPanel) / kGramPanel * kGramPanel;
  MatrixXd gram = MatrixXd::Zero(padded, padded);
  for (Index at = 0; at < inputs.cols(); at += kChunk) {
    const Index count = std::min(kChunk, inputs.cols() - at);
    const MatrixXd h = hidden_units(mlp, inputs.middleCols(at, count));
    MatrixXd features = MatrixXd::Zero(padded, count);
    for (Index n = 0; n < count; ++n) {
      const VectorXd slope = (1.0 - h.col(n).head(hidden).array().square()).matrix();
      for (Index i = 0; i + 1 < ins; ++i)
        features.col(n).segment(i * hidden, hidden) = slope * inputs(i, at + n);
      features.col(n).segment(first - hidden, hidden) = slope;
      features.col(n).segment(first, hidden + 1) = h.col(n);
    }
    add_gram(features, gram);
  }
  gram /= static_cast<double>(inputs.cols());
  MatrixXd out = gram.topLeftCorner(first, first);
  const LowerCholesky own = output_factor(gram.block(first, first, hidden + 1, hidden + 1), weight_decay);
  const MatrixXd root_coupling = own.matrixL().solve(gram.block(first, 0, hidden + 1, first));
  out.selfadjointView<Eigen::Lower>().rankUpdate(root_coupling.transpose(), -1.0);
  const MatrixXd mix = mlp.layers[1].weights.transpose() * mlp.layers[1].weights;
  for (Index column = 0; column < first; column += hidden)
    for (Index row = column; row < first; row += hidden)
      out.block(row, column, hidden, hidden).array() *= mix.array();
  out.diagonal().head(first - hidden).array() += weight_decay;
  return out;
}

std::optional<VectorXd> gauss_newton_step(MatrixXd matrix, const VectorXd& gradient, double damping) {
  matrix.diagonal().array() += damping;
  const LowerCholesky factor(matrix);
  if (factor.info() != Eigen::Success) return std::nullopt;
  VectorXd step = VectorXd::Zero(gradient.size());
  step.head(matrix.rows()) = factor.solve(-gradient.head(matrix.rows()));
  return step.allFinite() ? std::optional(std::move(step)) : std::nullopt;
}

}  // namespace faultline
