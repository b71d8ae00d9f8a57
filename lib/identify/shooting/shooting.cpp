// SPDX-License-Identifier: MIT
#include "lib/identify/shooting/shooting.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/shooting/shooting_evaluation.hpp"
#include "lib/identify/shooting/trailing_covariance.hpp"
#include "lib/identify/weak_form/weak_form.hpp"

namespace faultline {
namespace {

constexpr double kShootingSettled = 0.03;  ///< relative change of a noise level below which rounds end

constexpr double kConverged = 1e-7;   // relative decrease of the cost that ends the last solve: a step that
                                      // lowers it by less moves no parameter by a tenth of its std
constexpr double kGoodEnough = 1e-5;  // the same in rounds before, whose weights are not final
constexpr double kFreeBlocks = 0.5;   // of the blocks: least number that counts as degrees of freedom
constexpr double kWhite =
    1.5;  // mean ratio of the sandwich's variances to the white ones: below, it is chance

/// Passes the prepared residuals and derivatives of an excerpt to Ceres.
class ExcerptCost : public ceres::CostFunction {
 public:
  ExcerptCost(const ShootingEvaluation& evaluation, int excerpt, int states, int free)
      : evaluation_(evaluation), excerpt_(excerpt) {
    set_num_residuals(evaluation.rows());
    mutable_parameter_block_sizes()->push_back(states);
    mutable_parameter_block_sizes()->push_back(free);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    const ReducedExcerpt& r = evaluation_.reduced[excerpt_];
    std::copy_n(r.residual.data(), r.residual.size(), residuals);
    if (!jacobians) return true;
    if (jacobians[0]) std::copy_n(r.by_state.data(), r.by_state.size(), jacobians[0]);
    if (jacobians[1]) std::copy_n(r.by_parameter.data(), r.by_parameter.size(), jacobians[1]);
    return true;
  }

 private:
  const ShootingEvaluation& evaluation_;
  int excerpt_;
};

class PriorCost : public ceres::CostFunction {
 public:
  PriorCost(int index, double value, double std, int free) : index_(index), value_(value), std_(std) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(free);
  }

  bool Evaluate(double const* const* x, double* residual, double** jacobians) const override {
    residual[0] = (x[0][index_] - value_) / std_;
    if (!jacobians || !jacobians[0]) return true;
    std::fill_n(jacobians[0], parameter_block_sizes()[0], 0.0);
    jacobians[0][index_] = 1.0 / std_;
    return true;
  }

 private:
  int index_;
  double value_, std_;
};

/// Returns the index of a parameter among the free ones; -1 if it is not free.
int free_index(const ShootingProblem& problem, int parameter) {
  const auto it = std::find(problem.free.begin(), problem.free.end(), parameter);
  return it == problem.free.end() ? -1 : static_cast<int>(it - problem.free.begin());
}

/// Adds every excerpt, every prior and the bounds of the parameters to `costs`.
void add_costs(const ShootingProblem& problem, ShootingEvaluation& evaluation, ceres::Problem& costs) {
  const ParameterSpace& space = problem.space;
  double* parameters = evaluation.values();
  const int count = static_cast<int>(problem.free.size());
  for (std::size_t i = 0; i < evaluation.count(); ++i)
    costs.AddResidualBlock(new ExcerptCost(evaluation, static_cast<int>(i), 2 * space.joints(), count),
                           nullptr, evaluation.state(i), parameters);
  for (const auto& prior : problem.priors)
    if (const int k = free_index(problem, prior.parameter); k >= 0)
      costs.AddResidualBlock(new PriorCost(k, prior.value, prior.std, count), nullptr, parameters);
  if (const int k = free_index(problem, space.timing()); k >= 0) {
    costs.SetParameterLowerBound(parameters, k, -1.0);
    costs.SetParameterUpperBound(parameters, k, 2.0);
  }
  for (int j = 0; j < space.joints(); ++j)
    if (const int k = free_index(problem, space.log_width(j)); k >= 0) {
      costs.SetParameterLowerBound(parameters, k, elementary::log(evaluation.narrowest_width(j)));
      costs.SetParameterUpperBound(parameters, k, elementary::log(0.5));
    }
}

ceres::Solver::Summary solve(ceres::Problem& problem, ShootingEvaluation& evaluation, int max_iterations,
                             bool last) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;  // the reduced system is small and dense
  options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (std::size_t i = 0; i < evaluation.count(); ++i)
    options.linear_solver_ordering->AddElementToGroup(evaluation.state(i), 0);
  options.linear_solver_ordering->AddElementToGroup(evaluation.values(), 1);
  options.max_num_iterations = max_iterations;
  options.function_tolerance = last ? kConverged : kGoodEnough;
  options.parameter_tolerance = 1e-10;
  options.gradient_tolerance = 1e-12;
  options.initial_trust_region_radius = 1e6;
  options.max_num_line_search_step_size_iterations = 0;  // a step is cut at its bounds, without line search
  options.num_threads = 1;  // Ceres adds up in the order of threads; the evaluation is parallel itself
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary;
}

/// Returns the std of the residual by channel without outliers, corrected for the unknowns fitted.
Eigen::VectorXd measure_noise(const std::vector<Eigen::MatrixXd>& residuals,
                              std::span<const Excerpt> excerpts, const Eigen::VectorXd& old,
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

double total_s(std::span<const Excerpt> excerpts) {
  double sum = 0.0;
  for (const Excerpt& e : excerpts) sum += e.time[e.rows() - 1] - e.time[0];
  return sum;
}

/// Computes the covariance of the free parameters for white residuals; false if it is singular.
bool white_covariance(const ShootingProblem& problem, const ShootingEvaluation& evaluation,
                      Eigen::MatrixXd& out) {
  const auto free = static_cast<Eigen::Index>(problem.free.size());
  std::vector<Eigen::MatrixXd> groups(1, Eigen::MatrixXd(0, free));  // the priors, then each excerpt
  for (const ParameterPrior& prior : problem.priors)
    if (const int k = free_index(problem, prior.parameter); k >= 0) {
      groups[0].conservativeResize(groups[0].rows() + 1, Eigen::NoChange);
      groups[0].bottomRows<1>() = Eigen::RowVectorXd::Unit(free, k) / prior.std;
    }
  for (const ReducedExcerpt& r : evaluation.reduced) {
    Eigen::MatrixXd& group = groups.emplace_back(r.residual.size(), r.by_state.cols() + free);
    group << r.by_state, r.by_parameter;
  }
  return trailing_covariance(groups, free, out);
}

/// Returns the sandwich covariance over blocks of about a second: it includes correlated residuals.
Eigen::MatrixXd sandwich(const ShootingEvaluation& evaluation, std::span<const Excerpt> excerpts,
                         const Eigen::MatrixXd& white) {
  const Eigen::Index m = white.rows();
  const double block_s = residual_block_s(total_s(excerpts), static_cast<double>(m));
  Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(m);
  double blocks = 0.0;
  for (std::size_t i = 0; i < excerpts.size(); ++i) {
    // At the optimum an excerpt's gradient by its own start is zero: what remains is that of the parameters.
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

/// Returns the white covariance with every std at least that of the sandwich, or, if their mean ratio is
/// below kWhite, all scaled by that ratio.
Eigen::MatrixXd widened(const Eigen::MatrixXd& white, const Eigen::MatrixXd& robust) {
  const double mean = robust.diagonal().cwiseQuotient(white.diagonal().cwiseMax(1e-300)).mean();
  if (mean < kWhite) {
    const double factor = std::sqrt(std::max(1.0, mean));
    return factor * factor * white;
  }
  Eigen::VectorXd factor(white.rows());
  for (Eigen::Index k = 0; k < white.rows(); ++k)
    factor[k] = white(k, k) > 0.0 ? std::sqrt(std::max(1.0, robust(k, k) / white(k, k))) : 1.0;
  return factor.asDiagonal() * white * factor.asDiagonal();
}

/// Computes the covariance of all parameters of the space, zero for those not free; false if it is singular.
bool measure_covariance(const ShootingProblem& problem, ShootingEvaluation& evaluation, ShootingFit& fit) {
  evaluation.PrepareForEvaluation(true, true);
  Eigen::MatrixXd white;
  if (!white_covariance(problem, evaluation, white)) return false;
  const Eigen::MatrixXd wide = widened(white, sandwich(evaluation, problem.excerpts, white));
  const std::vector<int>& free = problem.free;
  for (std::size_t i = 0; i < free.size(); ++i)
    for (std::size_t k = 0; k < free.size(); ++k) fit.covariance(free[i], free[k]) = wide(i, k);
  return true;
}

}  // namespace

ShootingFit fit_shooting(const ShootingProblem& problem, const Progress& progress) {
  ShootingFit fit;
  fit.parameters = problem.start;
  fit.noise = problem.first_noise();
  fit.covariance.setZero(problem.space.count(), problem.space.count());
  ShootingEvaluation evaluation(problem);
  ceres::Problem::Options costs_options;
  costs_options.evaluation_callback = &evaluation;
  ceres::Problem costs(costs_options);
  add_costs(problem, evaluation, costs);
  bool settled = false;
  int rounds = 0, iterations = 0;
  ceres::Solver::Summary summary;
  while (rounds < problem.max_rounds) {
    if (progress) progress("identifying", static_cast<double>(rounds) / problem.max_rounds);
    summary = solve(costs, evaluation, problem.max_iterations, settled);
    iterations += static_cast<int>(summary.iterations.size()) - 1;
    ++rounds;
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
  fit.reason =
      fmt::format("{} iterations in {} rounds over {} segments; {}", iterations, rounds,
                  problem.excerpts.size(), fit.converged ? "converged" : "stopped before convergence");
  if (!measure_covariance(problem, evaluation, fit)) {
    fit.converged = false;
    fit.reason += "; the covariance is singular";
  }
  return fit;
}

}  // namespace faultline
