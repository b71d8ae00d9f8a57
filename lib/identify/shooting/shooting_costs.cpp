// SPDX-License-Identifier: MIT
#include "lib/identify/shooting/shooting_costs.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

/// Hands Ceres what the evaluation has prepared.
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

}  // namespace

void add_costs(const ShootingProblem& problem, ShootingEvaluation& evaluation, ceres::Problem& costs) {
  const ParameterSpace& space = problem.space;
  const std::vector<int>& free = problem.free;
  double* parameters = evaluation.values();
  const int count = static_cast<int>(free.size());
  for (std::size_t i = 0; i < evaluation.count(); ++i)
    costs.AddResidualBlock(new ExcerptCost(evaluation, static_cast<int>(i), 2 * space.joints(), count),
                           nullptr, evaluation.state(i), parameters);
  const auto index_of = [&](int p) {
    const auto it = std::find(free.begin(), free.end(), p);
    return it == free.end() ? -1 : static_cast<int>(it - free.begin());
  };
  for (const auto& prior : problem.priors)
    if (const int k = index_of(prior.parameter); k >= 0)
      costs.AddResidualBlock(new PriorCost(k, prior.value, prior.std, count), nullptr, parameters);
  if (const int k = index_of(space.timing()); k >= 0) {
    costs.SetParameterLowerBound(parameters, k, -1.0);
    costs.SetParameterUpperBound(parameters, k, 2.0);
  }
  for (int j = 0; j < space.joints(); ++j)
    if (const int k = index_of(space.log_width(j)); k >= 0) {
      costs.SetParameterLowerBound(parameters, k, elementary::log(evaluation.narrowest_width(j)));
      costs.SetParameterUpperBound(parameters, k, elementary::log(0.5));
    }
}

}  // namespace faultline
