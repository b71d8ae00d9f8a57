// SPDX-License-Identifier: MIT
#include "lib/neural/normal_equations.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

/// Returns the inputs of every layer for some patterns, followed by the network's outputs.
std::vector<MatrixXd> layer_inputs(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs) {
  std::vector<MatrixXd> values{inputs};
  Mlp one;
  for (std::size_t l = 0; l < mlp.layers.size(); ++l) {
    const bool last = l + 1 == mlp.layers.size();
    one.layers = {mlp.layers[l]};
    one.output = last ? mlp.output : OutputKind::linear;
    MatrixXd next = forward(one, values.back());
    if (!last)
      for (Index n = 0; n < next.cols(); ++n)
        for (Index k = 0; k < next.rows(); ++k) next(k, n) = elementary::tanh(next(k, n));
    values.push_back(std::move(next));
  }
  return values;
}

/// Returns in column n row `b` of a matrix B with B^T B = H, H the Hessian of pattern n's loss by the
/// weighted sums.
MatrixXd root_hessian_rows(OutputKind kind, const MatrixXd& outputs, Index b) {
  MatrixXd rows = MatrixXd::Zero(outputs.rows(), outputs.cols());
  for (Index n = 0; n < outputs.cols(); ++n) {
    const double y = outputs(b, n);
    if (kind == OutputKind::linear) rows(b, n) = 1.0;
    if (kind == OutputKind::logistic) rows(b, n) = std::sqrt(y * (1.0 - y));
    if (kind == OutputKind::softmax) {
      rows.col(n) = -std::sqrt(y) * outputs.col(n);
      rows(b, n) += std::sqrt(y);
    }
  }
  return rows;
}

/// Back-propagates `delta` (outputs x patterns) into the derivative by every parameter (parameters x
/// patterns).
MatrixXd jacobian_columns(const Mlp& mlp, const std::vector<MatrixXd>& values, MatrixXd delta) {
  MatrixXd columns(mlp.parameters(), delta.cols());
  Index end = columns.rows();
  for (std::size_t l = mlp.layers.size(); l-- > 0;) {
    const MatrixXd& weights = mlp.layers[l].weights;
    const MatrixXd& in = values[l];
    end -= weights.size() + weights.rows();
    for (Index i = 0; i < weights.cols(); ++i)
      columns.middleRows(end + i * weights.rows(), weights.rows()) =
          (delta.array().rowwise() * in.row(i).array()).matrix();
    columns.middleRows(end + weights.size(), weights.rows()) = delta;
    if (l > 0) delta = ((weights.transpose() * delta).array() * (1.0 - in.array().square())).matrix();
  }
  return columns;
}

/// Adds the weight decay to the diagonal entries that belong to weights.
void add_weight_decay(MatrixXd& normal, const Mlp& mlp, double weight_decay) {
  Index at = 0;
  for (const MlpLayer& layer : mlp.layers) {
    normal.diagonal().segment(at, layer.weights.size()).array() += weight_decay;
    at += layer.weights.size() + layer.bias.size();
  }
}

/// Values of the hidden units, with a last row of ones for the bias of the outputs.
MatrixXd hidden_units(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs) {
  const Index hidden = mlp.layers[1].weights.cols();
  MatrixXd units(hidden + 1, inputs.cols());
  units.topRows(hidden) = layer_inputs(mlp, inputs)[1];
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

}  // namespace

MatrixXd gauss_newton_matrix(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs) {
  MatrixXd normal = MatrixXd::Zero(mlp.parameters(), mlp.parameters());
  for (Index at = 0; at < inputs.cols(); at += kChunk) {
    const auto values = layer_inputs(mlp, inputs.middleCols(at, std::min(kChunk, inputs.cols() - at)));
    for (Index b = 0; b < mlp.outputs(); ++b)
      normal.selfadjointView<Eigen::Lower>().rankUpdate(
          jacobian_columns(mlp, values, root_hessian_rows(mlp.output, values.back(), b)));
  }
  return normal / static_cast<double>(inputs.cols());
}

bool has_projected_outputs(const Mlp& mlp) {
  return mlp.layers.size() == 2 && mlp.output == OutputKind::linear;
}

MlpLayer fitted_outputs(const Mlp& mlp, const Patterns& patterns, double weight_decay) {
  const Index hidden = mlp.layers[1].weights.cols();
  const double count = static_cast<double>(patterns.inputs.cols());
  const MatrixXd units = hidden_units(mlp, patterns.inputs);
  const LowerCholesky factor = output_factor(units * units.transpose() / count, weight_decay);
  const MatrixXd weights = factor.solve(units * patterns.targets.transpose() / count);
  return {weights.topRows(hidden).transpose(), weights.row(hidden).transpose()};
}

GaussNewtonSystem::GaussNewtonSystem(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs,
                                     double weight_decay) {
  if (has_projected_outputs(mlp)) {
    matrix_ = hidden_layer_matrix(mlp, inputs, weight_decay);
    return;
  }
  matrix_ = gauss_newton_matrix(mlp, inputs);
  add_weight_decay(matrix_, mlp, weight_decay);
}

std::optional<VectorXd> GaussNewtonSystem::step(const VectorXd& gradient, double damping) const {
  MatrixXd damped = matrix_;
  damped.diagonal().array() += damping;
  const LowerCholesky factor(damped);
  if (factor.info() != Eigen::Success) return std::nullopt;
  VectorXd step = VectorXd::Zero(gradient.size());
  step.head(damped.rows()) = factor.solve(-gradient.head(damped.rows()));
  return step.allFinite() ? std::optional(std::move(step)) : std::nullopt;
}

}  // namespace faultline
