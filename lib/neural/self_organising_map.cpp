// SPDX-License-Identifier: MIT
#include "lib/neural/self_organising_map.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"
#include "lib/core/random.hpp"

namespace faultline {
namespace {

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
  const double radius_start = std::max(
      options.initial_radius > 0.0 ? options.initial_radius : 0.5 * longer_side, options.final_radius);
  std::vector<int> order(inputs.cols());
  std::iota(order.begin(), order.end(), 0);
  const double shows = static_cast<double>(options.epochs) * static_cast<double>(order.size());
  double shown = 0.0;
  for (int epoch = 0; epoch < options.epochs; ++epoch) {
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    for (int pattern : order) {
      const double share = shown++ / shows;
      pull_neighbours(map, inputs.col(pattern), nearest_node(map, inputs.col(pattern)),
                      geometric(options.initial_rate, options.final_rate, share),
                      geometric(radius_start, options.final_radius, share));
    }
  }
  return map;
}

}  // namespace faultline
