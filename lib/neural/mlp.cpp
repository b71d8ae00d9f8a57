// SPDX-License-Identifier: MIT
#include "lib/neural/mlp.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"
#include "lib/core/random.hpp"
#include "lib/neural/kernels.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void apply_tanh(MatrixXd& values) {
  const Eigen::Index whole = values.size() / kLanes * kLanes;
  tanh_in_place(values.data(), static_cast<int>(whole));
  double rest[kLanes] = {};
  std::copy(values.data() + whole, values.data() + values.size(), rest);
  tanh_in_place(rest, kLanes);
  std::copy(rest, rest + (values.size() - whole), values.data() + whole);
}

/// `values` is outputs x samples with `stride` between the outputs of a sample.
void apply_output(OutputKind kind, double* values, int outputs, int stride) {
  if (kind == OutputKind::linear) return;
  if (kind == OutputKind::logistic) {
    for (int o = 0; o < outputs; ++o) values[o * stride] = 1.0 / (1.0 + elementary::exp(-values[o * stride]));
    return;
  }
  double largest = values[0], sum = 0.0;
  for (int o = 1; o < outputs; ++o) largest = std::max(largest, values[o * stride]);
  for (int o = 0; o < outputs; ++o) sum += values[o * stride] = elementary::exp(values[o * stride] - largest);
  for (int o = 0; o < outputs; ++o) values[o * stride] /= sum;
}

double loss_of(OutputKind kind, const MatrixXd& outputs, const Eigen::Ref<const MatrixXd>& targets) {
  constexpr double kTiny = 1e-300;
  const auto y = outputs.array();
  const auto t = targets.array();
  if (kind == OutputKind::linear) return 0.5 * (outputs - targets).squaredNorm();
  double loss = -(t * y.max(kTiny).unaryExpr(&elementary::log)).sum();
  if (kind == OutputKind::logistic)
    loss -= ((1.0 - t) * (1.0 - y).max(kTiny).unaryExpr(&elementary::log)).sum();
  return loss;
}

}  // namespace

const char* to_string(OutputKind kind) {
  return kind == OutputKind::linear ? "linear" : kind == OutputKind::logistic ? "logistic" : "softmax";
}

int Mlp::parameters() const {
  Eigen::Index count = 0;
  for (const MlpLayer& layer : layers) count += layer.weights.size() + layer.bias.size();
  return static_cast<int>(count);
}

Mlp make_mlp(const std::vector<int>& sizes, OutputKind output, std::uint64_t seed) {
  if (sizes.size() < 2 || std::any_of(sizes.begin(), sizes.end(), [](int n) { return n < 1; }))
    throw Error(ErrorCode::usage, "network", "needs an input and an output layer, each of at least one unit");
  Random random(seed);
  Mlp mlp;
  mlp.output = output;
  for (std::size_t l = 1; l < sizes.size(); ++l) {
    const double range = std::sqrt(6.0 / (sizes[l - 1] + sizes[l]));
    MlpLayer layer{MatrixXd(sizes[l], sizes[l - 1]), VectorXd(sizes[l])};
    for (double& weight : layer.weights.reshaped()) weight = random.uniform(-range, range);
    for (double& bias : layer.bias) bias = random.uniform(-range, range);
    if (l + 1 == sizes.size()) layer.bias.setZero();
    mlp.layers.push_back(std::move(layer));
  }
  return mlp;
}

MatrixXd forward(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs) {
  MatrixXd outputs(mlp.outputs(), inputs.cols());
  int widest = mlp.inputs();
  for (const MlpLayer& layer : mlp.layers) widest = std::max(widest, static_cast<int>(layer.bias.size()));
  std::vector<double> now(widest * kLanes), next(widest * kLanes);
  for (Eigen::Index first = 0; first < inputs.cols(); first += kLanes) {
    const int samples = static_cast<int>(std::min<Eigen::Index>(kLanes, inputs.cols() - first));
    for (int lane = 0; lane < kLanes; ++lane)  // unused lanes of the last block repeat the first sample
      for (int i = 0; i < mlp.inputs(); ++i)
        now[i * kLanes + lane] = inputs(i, first + (lane < samples ? lane : 0));
    for (const MlpLayer& layer : mlp.layers) {
      affine_lanes(layer.weights, layer.bias, now.data(), next.data());
      if (&layer != &mlp.layers.back())
        tanh_in_place(next.data(), static_cast<int>(layer.bias.size()) * kLanes);
      now.swap(next);
    }
    for (int lane = 0; lane < samples; ++lane) {
      apply_output(mlp.output, now.data() + lane, mlp.outputs(), kLanes);
      for (int o = 0; o < mlp.outputs(); ++o) outputs(o, first + lane) = now[o * kLanes + lane];
    }
  }
  return outputs;
}

VectorXd parameters_of(const Mlp& mlp) {
  VectorXd all(mlp.parameters());
  Eigen::Index at = 0;
  for (const MlpLayer& layer : mlp.layers) {
    all.segment(at, layer.weights.size()) = layer.weights.reshaped();
    all.segment(at + layer.weights.size(), layer.bias.size()) = layer.bias;
    at += layer.weights.size() + layer.bias.size();
  }
  return all;
}

void set_parameters(Mlp& mlp, const VectorXd& parameters) {
  Eigen::Index at = 0;
  for (MlpLayer& layer : mlp.layers) {
    layer.weights.reshaped() = parameters.segment(at, layer.weights.size());
    layer.bias = parameters.segment(at + layer.weights.size(), layer.bias.size());
    at += layer.weights.size() + layer.bias.size();
  }
}

LossGradient loss_gradient(const Mlp& mlp, const Eigen::Ref<const MatrixXd>& inputs,
                           const Eigen::Ref<const MatrixXd>& targets, double weight_decay) {
  std::vector<MatrixXd> activations;  // of each layer, outputs x patterns
  for (std::size_t l = 0; l < mlp.layers.size(); ++l) {
    const MlpLayer& layer = mlp.layers[l];
    MatrixXd sums = l == 0 ? MatrixXd(layer.weights * inputs) : MatrixXd(layer.weights * activations.back());
    sums.colwise() += layer.bias;
    if (l + 1 < mlp.layers.size()) apply_tanh(sums);
    activations.push_back(std::move(sums));
  }
  MatrixXd& outputs = activations.back();
  for (Eigen::Index n = 0; n < outputs.cols(); ++n)
    apply_output(mlp.output, outputs.col(n).data(), mlp.outputs(), 1);

  const double share = 1.0 / static_cast<double>(inputs.cols());
  LossGradient result{loss_of(mlp.output, outputs, targets) * share, VectorXd(mlp.parameters())};
  MatrixXd delta = (outputs - targets) * share;  // dloss / d weighted sums of the layer
  Eigen::Index end = result.gradient.size();
  for (std::size_t l = mlp.layers.size(); l-- > 0;) {
    const MlpLayer& layer = mlp.layers[l];
    result.loss += 0.5 * weight_decay * layer.weights.squaredNorm();
    const Eigen::Index begin = end - layer.weights.size() - layer.bias.size();
    Eigen::Map<MatrixXd> weights_part(result.gradient.data() + begin, layer.weights.rows(),
                                      layer.weights.cols());
    if (l == 0)
      weights_part.noalias() = delta * inputs.transpose();
    else
      weights_part.noalias() = delta * activations[l - 1].transpose();
    weights_part += weight_decay * layer.weights;
    result.gradient.segment(begin + layer.weights.size(), layer.bias.size()) = delta.rowwise().sum();
    if (l > 0)
      delta = ((layer.weights.transpose() * delta).array() * (1.0 - activations[l - 1].array().square()))
                  .matrix();
    end = begin;
  }
  return result;
}

double mean_squared_error(const Mlp& mlp, const Patterns& patterns) {
  return (forward(mlp, patterns.inputs) - patterns.targets).squaredNorm() /
         static_cast<double>(std::max<Eigen::Index>(patterns.targets.size(), 1));
}

}  // namespace faultline
