// SPDX-License-Identifier: MIT
#include "lib/neural/normal_equations.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/neural/gram.hpp"
#include "lib/neural/kernels.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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

/// With z_(i,k) = (1 - h_k^2) x_i and x, h extended by 1 for the biases, J has W2(o,k) z_(i,k) for the first
/// layer and h_k for output o's own weights, so one Gram matrix of [z; h] serves all outputs.
TwoLayerBlocks two_layer_blocks(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs) {
  const Index hidden = mlp.layers[1].weights.cols(), ins = inputs.rows() + 1, first = hidden * ins;
  const Index padded = (first + hidden + kGramPanel) / kGramPanel * kGramPanel;
  MatrixXd gram = MatrixXd::Zero(padded, padded);
  Mlp front{{mlp.layers[0]}, OutputKind::linear};
  for (Index at = 0; at < inputs.cols(); at += kChunk) {
    const Index count = std::min(kChunk, inputs.cols() - at);
    MatrixXd h = forward(front, inputs.middleCols(at, count));
    MatrixXd features = MatrixXd::Zero(padded, count);
    for (Index n = 0; n < count; ++n) {
      for (Index k = 0; k < hidden; ++k) h(k, n) = elementary::tanh(h(k, n));
      const VectorXd slope = (1.0 - h.col(n).array().square()).matrix();
      for (Index i = 0; i + 1 < ins; ++i)
        features.col(n).segment(i * hidden, hidden) = slope * inputs(i, at + n);
      features.col(n).segment(first - hidden, hidden) = slope;
      features.col(n).segment(first, hidden) = h.col(n);
      features(first + hidden, n) = 1.0;
    }
    add_gram(features, gram);
  }
  gram /= static_cast<double>(inputs.cols());
  return {gram.topLeftCorner(first, first), gram.block(first, 0, hidden + 1, first),
          gram.block(first, first, hidden + 1, hidden + 1), mlp.layers[1].weights};
}

/// Multiplies the columns of the coupling, or a vector of the first layer, by the weights of output `o`.
VectorXd weighted(const TwoLayerBlocks& blocks, Index o, const VectorXd& front) {
  const Index hidden = blocks.mix.cols();
  VectorXd out(front.size());
  for (Index at = 0; at < front.size(); at += hidden)
    out.segment(at, hidden) = front.segment(at, hidden).cwiseProduct(blocks.mix.row(o).transpose());
  return out;
}

/// The matrix of the first layer without that of the outputs: (G - C^T own^-1 C) * (W2^T W2) by hidden units.
MatrixXd front_alone(const TwoLayerBlocks& blocks, const MatrixXd& root_coupling) {
  const Index hidden = blocks.mix.cols();
  const MatrixXd mix = blocks.mix.transpose() * blocks.mix;
  MatrixXd out = blocks.front;
  out.selfadjointView<Eigen::Lower>().rankUpdate(root_coupling.transpose(), -1.0);
  for (Index column = 0; column < out.cols(); column += hidden)
    for (Index row = column; row < out.rows(); row += hidden)
      out.block(row, column, hidden, hidden).array() *= mix.array();
  return out;
}

using LowerCholesky = Eigen::LLT<MatrixXd, Eigen::Lower>;

std::optional<VectorXd> solved(const MatrixXd& matrix, const VectorXd& gradient, double damping) {
  MatrixXd damped = matrix;
  damped.diagonal().array() += damping;
  const LowerCholesky factor(damped);
  if (factor.info() != Eigen::Success) return std::nullopt;
  VectorXd step = factor.solve(-gradient);
  return step.allFinite() ? std::optional(std::move(step)) : std::nullopt;
}

/// Eliminates the weights of the outputs, each of which has the same block, and solves for the first layer.
std::optional<VectorXd> solved(const TwoLayerBlocks& blocks, double weight_decay, const VectorXd& gradient,
                               double damping) {
  const Index hidden = blocks.mix.cols(), outputs = blocks.mix.rows(), first = blocks.front.rows();
  MatrixXd own = blocks.own;
  own.diagonal().array() += damping;
  own.diagonal().head(hidden).array() += weight_decay;
  const LowerCholesky factor(own);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const Eigen::Map<const MatrixXd> tail(gradient.data() + first, outputs, hidden + 1);
  const MatrixXd solved_tail = factor.solve(tail.transpose());  // hidden units and 1 x outputs
  MatrixXd front = front_alone(blocks, factor.matrixL().solve(blocks.coupling));
  front.diagonal().head(first - hidden).array() += weight_decay;
  VectorXd head = gradient.head(first);
  for (Index o = 0; o < outputs; ++o)
    head -= weighted(blocks, o, blocks.coupling.transpose() * solved_tail.col(o));
  const std::optional<VectorXd> first_layer = solved(front, head, damping);
  if (!first_layer) return std::nullopt;
  VectorXd step(gradient.size());
  step.head(first) = *first_layer;
  Eigen::Map<MatrixXd> out(step.data() + first, outputs, hidden + 1);
  for (Index o = 0; o < outputs; ++o)
    out.row(o) = -solved_tail.col(o).transpose() -
                 factor.solve(blocks.coupling * weighted(blocks, o, *first_layer)).transpose();
  return step.allFinite() ? std::optional(std::move(step)) : std::nullopt;
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

GaussNewtonSystem::GaussNewtonSystem(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs,
                                     double weight_decay)
    : weight_decay_(weight_decay) {
  if (mlp.layers.size() == 2 && mlp.output == OutputKind::linear) {
    matrix_ = two_layer_blocks(mlp, inputs);
    return;
  }
  MatrixXd matrix = gauss_newton_matrix(mlp, inputs);
  add_weight_decay(matrix, mlp, weight_decay);
  matrix_ = std::move(matrix);
}

double GaussNewtonSystem::mean_diagonal() const {
  if (const auto* matrix = std::get_if<MatrixXd>(&matrix_)) return matrix->diagonal().mean();
  const auto& blocks = std::get<TwoLayerBlocks>(matrix_);
  const Index hidden = blocks.mix.cols(), outputs = blocks.mix.rows(), first = blocks.front.rows(),
              own = outputs * (hidden + 1);
  const VectorXd power = blocks.mix.colwise().squaredNorm().transpose();
  double sum = static_cast<double>(outputs) * blocks.own.trace() +
               weight_decay_ * static_cast<double>(first - hidden + outputs * hidden);
  for (Index at = 0; at < first; at += hidden) sum += blocks.front.diagonal().segment(at, hidden).dot(power);
  return sum / static_cast<double>(first + own);
}

std::optional<VectorXd> GaussNewtonSystem::step(const VectorXd& gradient, double damping) const {
  if (const auto* matrix = std::get_if<MatrixXd>(&matrix_)) return solved(*matrix, gradient, damping);
  return solved(std::get<TwoLayerBlocks>(matrix_), weight_decay_, gradient, damping);
}

}  // namespace faultline
