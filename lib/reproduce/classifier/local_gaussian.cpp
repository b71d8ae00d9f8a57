// SPDX-License-Identifier: MIT
#include "lib/reproduce/classifier/local_gaussian.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRidge = 1e-6;  // share of each input's power
constexpr std::size_t kNeighbours = 20;
constexpr double kShareOfAll = 0.01;  // of the overall covariance, so that the local one has full rank

}  // namespace

LocalGaussian fit_local_gaussian(const MatrixXd& inputs, const MatrixXd& outputs) {
  LocalGaussian gaussian;
  const double count = static_cast<double>(inputs.cols());
  MatrixXd gram = inputs * inputs.transpose();
  gram.diagonal() *= 1.0 + kRidge;
  gaussian.trend = gram.ldlt().solve(inputs * outputs.transpose()).transpose();
  gaussian.scale = (inputs.rowwise().norm() / std::sqrt(count)).cwiseMax(1e-12);
  gaussian.inputs = gaussian.scale.cwiseInverse().asDiagonal() * inputs;
  gaussian.rest = outputs - gaussian.trend * inputs;
  gaussian.covariance = gaussian.rest * gaussian.rest.transpose() / count;
  return gaussian;
}

VectorXd mean_at(const LocalGaussian& gaussian, const VectorXd& input) { return gaussian.trend * input; }

MatrixXd covariance_at(const LocalGaussian& gaussian, const VectorXd& input) {
  const VectorXd scaled = input.cwiseQuotient(gaussian.scale);
  const VectorXd distance = (gaussian.inputs.colwise() - scaled).colwise().squaredNorm();
  std::vector<int> order(distance.size());
  std::iota(order.begin(), order.end(), 0);
  const std::size_t count = std::min(kNeighbours, order.size());
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count - 1), order.end(),
                   [&](int a, int b) { return distance[a] < distance[b]; });
  order.resize(count);
  const MatrixXd near = gaussian.rest(Eigen::all, order);
  return near * near.transpose() / static_cast<double>(count) + kShareOfAll * gaussian.covariance;
}

}  // namespace faultline
