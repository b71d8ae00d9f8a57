// SPDX-License-Identifier: MIT
#include "lib/identify/shooting/shooting.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "lib/core/statistics.hpp"
#include "lib/identify/shooting/shooting_costs.hpp"
#include "lib/identify/shooting/shooting_covariance.hpp"
#include "lib/identify/shooting/shooting_evaluation.hpp"

namespace faultline {
namespace {

constexpr double kShootingSettled = 0.03;  ///< relative change of a noise level below which rounds end

ceres::Solver::Summary solve(ceres::Problem& problem, ShootingEvaluation& evaluation, int max_iterations,
                             bool last) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;  // what is left after the starts is small and full
  options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (std::size_t i = 0; i < evaluation.count(); ++i)
    options.linear_solver_ordering->AddElementToGroup(evaluation.state(i), 0);
  options.linear_solver_ordering->AddElementToGroup(evaluation.values(), 1);
  options.max_num_iterations = max_iterations;
  options.function_tolerance = last ? 1e-9 : 1e-5;
  options.parameter_tolerance = 1e-10;
  options.gradient_tolerance = 1e-12;
  options.initial_trust_region_radius = 1e6;
  options.max_num_line_search_step_size_iterations = 0;  // a step is cut at its bounds, not searched along
  options.num_threads = 1;  // Ceres adds up in the order of threads; the evaluation is parallel itself
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary;
}

/// Weighted std of what is left by channel, counting the starts and parameters that were fitted.
Eigen::VectorXd measure_noise(const std::vector<Eigen::MatrixXd>& residuals,
                              const std::vector<Excerpt>& excerpts, const Eigen::VectorXd& old,
                              const Eigen::VectorXd& floor, int free) {
  const Eigen::Index n2 = old.size();
  Eigen::VectorXd out = old;
  double measured = 0.0;
  std::vector<std::vector<double>> size(n2);
  for (std::size_t i = 0; i < residuals.size(); ++i)
    for (Eigen::Index k = 0; k < residuals[i].cols(); ++k)
      for (Eigen::Index c = 0; c < n2; ++c)
        if (std::isfinite(residuals[i](c, k))) {
          size[c].push_back(std::abs(residuals[i](c, k)));
          measured += excerpts[i].weight(c, k);
        }
  const double fitted = static_cast<double>(residuals.size()) * static_cast<double>(n2) + free;
  const double correction = std::sqrt(measured / std::max(measured - fitted, 0.1 * measured));
  for (Eigen::Index c = 0; c < n2; ++c) {
    auto& s = size[c];
    if (s.empty()) continue;
    const double cut = kShootingOutlierStd * std::max(1.4826 * upper_median_of(s), floor[c]);
    double sum = 0.0, count = 0.0;
    for (double v : s)
      if (v <= cut) sum += v * v, count += 1.0;
    out[c] = std::max(floor[c], correction * std::sqrt(sum / std::max(count, 1.0)));
  }
  return out;
}

Eigen::VectorXd neighbour_correlation(const std::vector<Eigen::MatrixXd>& residuals, Eigen::Index channels) {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(channels),
                  square = Eigen::VectorXd::Constant(channels, 1e-300);
  for (const auto& r : residuals)
    for (Eigen::Index k = 1; k < r.cols(); ++k)
      for (Eigen::Index c = 0; c < channels; ++c)
        if (std::isfinite(r(c, k) + r(c, k - 1))) {
          product[c] += r(c, k) * r(c, k - 1);
          square[c] += 0.5 * (r(c, k) * r(c, k) + r(c, k - 1) * r(c, k - 1));
        }
  return product.cwiseQuotient(square);
}

/// Covariance of all parameters of the space, zero for those not free.
bool measure_covariance(const ShootingProblem& problem, ceres::Problem& costs, ShootingEvaluation& evaluation,
                        ShootingFit& fit) {
  evaluation.PrepareForEvaluation(true, true);
  Eigen::MatrixXd white;
  if (!white_covariance(costs, evaluation, white)) return false;
  const Eigen::MatrixXd wide = widen(white, sandwich(evaluation, problem.excerpts, white), fit.widened);
  const std::vector<int>& free = problem.free;
  for (std::size_t i = 0; i < free.size(); ++i)
    for (std::size_t k = 0; k < free.size(); ++k) fit.covariance(free[i], free[k]) = wide(i, k);
  return true;
}

}  // namespace

ShootingFit fit_shooting(const ShootingProblem& problem, const ShootingOptions& options,
                         const Progress& progress) {
  ShootingFit fit;
  fit.parameters = problem.start;
  fit.noise = problem.first_noise();
  fit.covariance.setZero(problem.space.count(), problem.space.count());
  fit.segments = static_cast<int>(problem.excerpts.size());
  ShootingEvaluation evaluation(problem, options.threads);
  ceres::Problem::Options costs_options;
  costs_options.evaluation_callback = &evaluation;
  ceres::Problem costs(costs_options);
  add_costs(problem, evaluation, costs);
  bool settled = false;
  ceres::Solver::Summary summary;
  while (fit.rounds < options.max_rounds) {
    if (progress) progress("identifying", static_cast<double>(fit.rounds) / options.max_rounds);
    summary = solve(costs, evaluation, options.max_iterations, settled);
    fit.iterations += static_cast<int>(summary.iterations.size()) - 1;
    ++fit.rounds;
    const auto residuals = evaluation.residuals();
    const Eigen::VectorXd next = measure_noise(residuals, problem.excerpts, fit.noise, problem.floor,
                                               static_cast<int>(problem.free.size()));
    const bool was_settled = settled;
    settled = ((next - fit.noise).array().abs() <= kShootingSettled * fit.noise.array()).all();
    fit.noise = next;
    fit.correlation = neighbour_correlation(residuals, next.size());
    if (was_settled) break;
    evaluation.reweight(residuals, next);
  }
  fit.parameters = evaluation.parameters();
  fit.converged = summary.termination_type == ceres::CONVERGENCE;
  fit.reason = fmt::format("{} iterations in {} rounds over {} segments; {}", fit.iterations, fit.rounds,
                           fit.segments, fit.converged ? "converged" : "stopped before convergence");
  if (!measure_covariance(problem, costs, evaluation, fit)) {
    fit.converged = false;
    fit.reason += "; the covariance is singular";
  }
  return fit;
}

}  // namespace faultline
