// SPDX-License-Identifier: MIT
#include "lib/neural/rbfn.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"
#include "lib/core/random.hpp"
#include "lib/neural/kernels.hpp"
#include "lib/neural/mlp.hpp"

namespace faultline {
namespace {

// Fractions of the distance to a pattern that a node moves, first and last; they fall geometrically.
constexpr double kInitialRate = 0.5, kFinalRate = 0.01;
constexpr double kFinalRadius = 0.4;  // of the neighbourhood in grid steps; falls from half the longer side
// Radii in multiples of sqrt(inputs) * spread, and ridge penalties on the output weights as shares of the
// units' mean power. Generalised cross-validation selects one of each.
constexpr std::array kWidths{0.5, 1.0, 2.0, 4.0};
constexpr std::array kRidges{1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1};
constexpr double kLeastRadius = 0.1;  // of a unit's spread, as a share of the input's standard deviation

void check(const Eigen::Ref<const Eigen::MatrixXd>& inputs, const SomOptions& options) {
  if (options.rows < 1 || options.columns < 1 || options.epochs < 1)
    throw Error(ErrorCode::usage, "self-organising map", "rows, columns and epochs must be at least 1");
  if (inputs.cols() == 0 || !inputs.allFinite())
    throw Error(ErrorCode::input, "self-organising map",
                "needs at least one pattern and only finite numbers");
}

double geometric(double from, double to, double share) { return from * elementary::pow(to / from, share); }

void pull_neighbours(SelfOrganisingMap& map, const Eigen::Ref<const Eigen::VectorXd>& input, int winner,
                     double rate, double radius) {
  constexpr double kTooFar = 7.0;  // nodes further away are not moved; exp(-7) < 0.001
  for (int node = 0; node < map.count(); ++node) {
    const double exponent = map.grid_distance2(winner, node) / (2.0 * radius * radius);
    if (exponent > kTooFar) continue;
    map.nodes.col(node) += rate * elementary::exp(-exponent) * (input - map.nodes.col(node));
  }
}

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Activation of every unit, units x samples.
MatrixXd activations(const MatrixXd& centres, const MatrixXd& inverse_radii,
                     const Eigen::Ref<const MatrixXd>& inputs) {
  MatrixXd out(centres.cols(), inputs.cols());
  std::vector<double> in(centres.rows() * kLanes), sums(centres.cols() * kLanes);
  for (Index first = 0; first < inputs.cols(); first += kLanes) {
    const int samples = static_cast<int>(std::min<Index>(kLanes, inputs.cols() - first));
    for (int lane = 0; lane < kLanes; ++lane)
      for (Index i = 0; i < inputs.rows(); ++i)
        in[i * kLanes + lane] = inputs(i, first + (lane < samples ? lane : 0));
    squared_distances_lanes(centres, inverse_radii, in.data(), sums.data());
    for (int lane = 0; lane < samples; ++lane)
      for (Index u = 0; u < out.rows(); ++u) out(u, first + lane) = 1.0 / (1.0 + sums[u * kLanes + lane]);
  }
  return out;
}

struct Units {
  MatrixXd centres;
  MatrixXd spread;  // inputs x units
};

/// Returns for each input the mean square distance to a node of the patterns of nodes within one grid step.
VectorXd local_variance(const SelfOrganisingMap& map, const std::vector<int>& nearest, const MatrixXd& inputs,
                        int node) {
  VectorXd sum = VectorXd::Zero(inputs.rows());
  int count = 0;
  for (Index n = 0; n < inputs.cols(); ++n) {
    if (map.grid_distance2(node, nearest[n]) > 1.0) continue;
    sum += (inputs.col(n) - map.nodes.col(node)).cwiseAbs2();
    ++count;
  }
  return sum / std::max(count, 1);
}

/// Returns the least spread of each input, never zero.
VectorXd spread_floor(const MatrixXd& inputs) {
  const VectorXd mean = inputs.rowwise().mean();
  const VectorXd deviation = (inputs.colwise() - mean).array().square().rowwise().mean().sqrt().matrix();
  return (kLeastRadius * deviation).cwiseMax(1e-9).cwiseMax(1e-9 * mean.cwiseAbs());
}

Units place_units(const MatrixXd& inputs, const SomOptions& options) {
  const SelfOrganisingMap map = train_som(inputs, options);
  std::vector<int> nearest(inputs.cols());
  std::vector<char> used(map.count(), 0);
  for (Index n = 0; n < inputs.cols(); ++n) used[nearest[n] = nearest_node(map, inputs.col(n))] = 1;
  std::vector<int> kept;
  for (int node = 0; node < map.count(); ++node)
    if (used[node]) kept.push_back(node);
  const VectorXd least = spread_floor(inputs);
  Units units{map.nodes(Eigen::all, kept), MatrixXd(inputs.rows(), kept.size())};
  for (std::size_t u = 0; u < kept.size(); ++u)
    units.spread.col(u) = local_variance(map, nearest, inputs, kept[u]).cwiseSqrt().cwiseMax(least);
  return units;
}

/// Ridge regression of the targets on the units for any penalty, by the eigenvalues of the units' Gram
/// matrix; the bias has no penalty.
class RidgeFit {
 public:
  RidgeFit(const MatrixXd& units, const MatrixXd& targets)
      : unit_mean_(units.rowwise().mean()), target_mean_(targets.rowwise().mean()), patterns_(units.cols()) {
    const MatrixXd centred = units.colwise() - unit_mean_, wanted = targets.colwise() - target_mean_;
    MatrixXd gram = MatrixXd::Zero(units.rows(), units.rows());
    gram.selfadjointView<Eigen::Lower>().rankUpdate(centred);
    solver_.compute(gram);
    power_ = solver_.eigenvalues().cwiseMax(0.0);
    projected_ = solver_.eigenvectors().transpose() * (centred * wanted.transpose());
    total_ = wanted.squaredNorm();
    outputs_ = static_cast<double>(targets.rows());
  }

  double penalty(double share) const { return std::max(share * power_.mean(), 1e-300); }

  /// Golub, Heath and Wahba's estimate of the mean squared error on new patterns.
  double generalised_error(double penalty) const {
    const auto shrink = (power_.array() + 2.0 * penalty) / (power_.array() + penalty).square();
    const double rest = std::max(total_ - (projected_.rowwise().squaredNorm().array() * shrink).sum(), 0.0);
    const double effective_weights = 1.0 + (power_.array() / (power_.array() + penalty)).sum();
    const double n = static_cast<double>(patterns_), free = n - effective_weights;
    if (free <= 0.5) return std::numeric_limits<double>::infinity();
    return rest * n / (free * free) / outputs_;
  }

  void weights(double penalty, Rbfn& rbfn) const {
    const MatrixXd scaled = (projected_.array().colwise() / (power_.array() + penalty)).matrix();
    rbfn.weights = (solver_.eigenvectors() * scaled).transpose();
    rbfn.bias = target_mean_ - rbfn.weights * unit_mean_;
  }

 private:
  VectorXd unit_mean_, target_mean_;
  Index patterns_;
  Eigen::SelfAdjointEigenSolver<MatrixXd> solver_;
  VectorXd power_;
  MatrixXd projected_;
  double total_ = 0.0, outputs_ = 1.0;
};

}  // namespace

double SelfOrganisingMap::grid_distance2(int a, int b) const {
  const int row = a / columns - b / columns, column = a % columns - b % columns;
  return static_cast<double>(row * row + column * column);
}

int nearest_node(const SelfOrganisingMap& map, const Eigen::Ref<const Eigen::VectorXd>& input) {
  int nearest = 0;
  double least = (map.nodes.col(0) - input).squaredNorm();
  for (int node = 1; node < map.count(); ++node) {
    const double distance = (map.nodes.col(node) - input).squaredNorm();
    if (distance < least) {
      least = distance;
      nearest = node;
    }
  }
  return nearest;
}

SelfOrganisingMap train_som(const Eigen::Ref<const Eigen::MatrixXd>& inputs, const SomOptions& options) {
  check(inputs, options);
  Random random(options.seed);
  SelfOrganisingMap map{options.rows, options.columns,
                        Eigen::MatrixXd(inputs.rows(), options.rows * options.columns)};
  for (int node = 0; node < map.count(); ++node)
    map.nodes.col(node) = inputs.col(random.below(inputs.cols()));
  const double longer_side = std::max(options.rows, options.columns);
  const double radius_start = std::max(0.5 * longer_side, kFinalRadius);
  std::vector<int> order(inputs.cols());
  std::iota(order.begin(), order.end(), 0);
  const double shows = static_cast<double>(options.epochs) * static_cast<double>(order.size());
  double shown = 0.0;
  for (int epoch = 0; epoch < options.epochs; ++epoch) {
    shuffle(order, random);
    for (int pattern : order) {
      const double share = shown++ / shows;
      pull_neighbours(map, inputs.col(pattern), nearest_node(map, inputs.col(pattern)),
                      geometric(kInitialRate, kFinalRate, share),
                      geometric(radius_start, kFinalRadius, share));
    }
  }
  return map;
}

MatrixXd forward(const Rbfn& rbfn, const Eigen::Ref<const MatrixXd>& inputs) {
  const Mlp readout{{{rbfn.weights, rbfn.bias}}, OutputKind::linear};
  return forward(readout, activations(rbfn.centres, rbfn.inverse_radii, inputs));
}

double mean_squared_error(const Rbfn& rbfn, const Patterns& patterns) {
  return (forward(rbfn, patterns.inputs) - patterns.targets).squaredNorm() /
         static_cast<double>(std::max<Index>(patterns.targets.size(), 1));
}

Rbfn train_rbfn(const Patterns& patterns, const SomOptions& map) {
  check_patterns(patterns, -1, -1, "training patterns of the RBFN");
  const Units units = place_units(patterns.inputs, map);
  Rbfn best;
  best.centres = units.centres;
  double least_error = std::numeric_limits<double>::infinity();
  for (const double width : kWidths) {
    const MatrixXd inverse_radii =
        (units.spread * (width * std::sqrt(static_cast<double>(patterns.inputs.rows())))).cwiseInverse();
    const RidgeFit fit(activations(units.centres, inverse_radii, patterns.inputs), patterns.targets);
    for (const double ridge : kRidges) {
      const double penalty = fit.penalty(ridge), error = fit.generalised_error(penalty);
      if (!(error < least_error) && best.weights.size() > 0) continue;
      least_error = error;
      best.inverse_radii = inverse_radii;
      fit.weights(penalty, best);
    }
  }
  return best;
}

}  // namespace faultline
