// SPDX-License-Identifier: MIT
#include "lib/neural/normal_equations.hpp"

#include <algorithm>
#include <cmath>
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

/// One hidden layer, linear outputs. With z_(i,k) = (1 - h_k^2) x_i and x, h extended by 1 for the biases, J
/// has W2(o,k) z_(i,k) for the first layer and h_k for output o's own weights, so one Gram matrix of [z; h]
/// serves all outputs.
MatrixXd two_layer_matrix(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs) {
  const MatrixXd& w2 = mlp.layers[1].weights;
  const Index hidden = w2.cols(), outputs = w2.rows(), ins = inputs.rows() + 1, first = hidden * ins;
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

  MatrixXd normal = MatrixXd::Zero(mlp.parameters(), mlp.parameters());
  const MatrixXd mix = w2.transpose() * w2;
  for (Index column = 0; column < ins; ++column)
    for (Index row = column; row < ins; ++row)
      normal.block(row * hidden, column * hidden, hidden, hidden) =
          gram.block(row * hidden, column * hidden, hidden, hidden).cwiseProduct(mix);
  for (Index k = 0; k <= hidden; ++k)
    for (Index o = 0; o < outputs; ++o) {
      const Index row = first + k * outputs + o;
      for (Index i = 0; i < ins; ++i)
        normal.row(row).segment(i * hidden, hidden) =
            gram.row(first + k).segment(i * hidden, hidden).cwiseProduct(w2.row(o));
      for (Index other = 0; other <= k; ++other)
        normal(row, first + other * outputs + o) = gram(first + k, first + other);
    }
  return normal;
}

}  // namespace

MatrixXd dense_gauss_newton_matrix(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs) {
  MatrixXd normal = MatrixXd::Zero(mlp.parameters(), mlp.parameters());
  for (Index at = 0; at < inputs.cols(); at += kChunk) {
    const auto values = layer_inputs(mlp, inputs.middleCols(at, std::min(kChunk, inputs.cols() - at)));
    for (Index b = 0; b < mlp.outputs(); ++b)
      normal.selfadjointView<Eigen::Lower>().rankUpdate(
          jacobian_columns(mlp, values, root_hessian_rows(mlp.output, values.back(), b)));
  }
  return normal / static_cast<double>(inputs.cols());
}

MatrixXd gauss_newton_matrix(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs) {
  const bool two_layers = mlp.layers.size() == 2 && mlp.output == OutputKind::linear;
  return two_layers ? two_layer_matrix(mlp, inputs) : dense_gauss_newton_matrix(mlp, inputs);
}

}  // namespace faultline
