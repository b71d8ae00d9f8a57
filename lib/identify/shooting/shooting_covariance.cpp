// SPDX-License-Identifier: MIT
#include "lib/identify/shooting/shooting_covariance.hpp"

#include <algorithm>
#include <cmath>

#include "lib/identify/residual_blocks.hpp"
#include "lib/identify/shooting/trailing_covariance.hpp"

namespace faultline {
namespace {

constexpr double kFreeBlocks = 0.5;  // share of the blocks that at least counts as free
constexpr double kWhite =
    1.5;  // mean ratio of the sandwich's variances to the white ones: chance, not correlation

double total_s(const std::vector<Excerpt>& excerpts) {
  double sum = 0.0;
  for (const Excerpt& e : excerpts) sum += e.time[e.rows() - 1] - e.time[0];
  return sum;
}

}  // namespace

bool white_covariance(ceres::Problem& costs, ShootingEvaluation& evaluation, Eigen::MatrixXd& out) {
  ceres::Problem::EvaluateOptions options;
  options.num_threads = 1;
  for (std::size_t i = 0; i < evaluation.count(); ++i)
    options.parameter_blocks.push_back(evaluation.state(i));
  options.parameter_blocks.push_back(evaluation.values());
  ceres::CRSMatrix jacobian;
  if (!costs.Evaluate(options, nullptr, nullptr, nullptr, &jacobian)) return false;
  return trailing_covariance(jacobian, jacobian.num_cols - evaluation.free(), out);
}

Eigen::MatrixXd sandwich(const ShootingEvaluation& evaluation, const std::vector<Excerpt>& excerpts,
                         const Eigen::MatrixXd& white) {
  const Eigen::Index m = white.rows();
  const double block_s = residual_block_s(total_s(excerpts), static_cast<double>(m));
  Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(m);
  double blocks = 0.0;
  for (std::size_t i = 0; i < excerpts.size(); ++i) {
    // At the optimum an excerpt's gradient with respect to its own start is zero: what is left is of the
    // parameters alone.
    g += evaluation.reduced[i].by_parameter.transpose() * evaluation.reduced[i].residual;
    const bool ends =
        i + 1 == excerpts.size() || excerpts[i + 1].log != excerpts[i].log ||
        std::floor(excerpts[i + 1].time[0] / block_s) != std::floor(excerpts[i].time[0] / block_s);
    if (!ends) continue;
    meat += g * g.transpose();
    g.setZero();
    blocks += 1.0;
  }
  const double correction = blocks / std::max({1.0, blocks - static_cast<double>(m), kFreeBlocks * blocks});
  return correction * white * meat * white;
}

Eigen::MatrixXd widen(const Eigen::MatrixXd& white, const Eigen::MatrixXd& robust, double& widened) {
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(white.rows());
  const double mean = robust.diagonal().cwiseQuotient(white.diagonal().cwiseMax(1e-300)).mean();
  if (mean < kWhite) {
    widened = std::sqrt(std::max(1.0, mean));
    return widened * widened * white;
  }
  for (Eigen::Index k = 0; k < white.rows(); ++k)
    factor[k] = white(k, k) > 0.0 ? std::sqrt(std::max(1.0, robust(k, k) / white(k, k))) : 1.0;
  widened = factor.maxCoeff();
  return factor.asDiagonal() * white * factor.asDiagonal();
}

}  // namespace faultline
