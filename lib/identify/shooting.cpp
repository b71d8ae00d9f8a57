// SPDX-License-Identifier: MIT
#include "lib/identify/shooting.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "lib/core/parallel.hpp"
#include "lib/identify/segment_model.hpp"

namespace faultline {
namespace {

constexpr double kOutlierStd = 4.0;
constexpr double kSettled = 0.03;  ///< relative change of a noise level below which rounds end
constexpr double kBlock_s = 1.0;
constexpr double kHuge = 1e6;  ///< residual that stands for a motion that diverged

/// What one excerpt adds to the problem, reduced to a triangular factor: same cost, gradient and Gauss-Newton
/// matrix as its thousands of rows.
struct Reduced {
  Eigen::VectorXd residual;                                                         ///< 2n + free + 1
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_state;  ///< (2n + free + 1) x 2n
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_parameter;
};

/// The problem's variables and what they give, excerpt by excerpt in parallel, in an order that does not
/// depend on the number of threads.
class Evaluation : public ceres::EvaluationCallback {
 public:
  Evaluation(const ParameterSpace& space, const std::vector<Excerpt>& excerpts, const Eigen::VectorXd& start,
             const std::vector<int>& free, const Eigen::VectorXd& noise, int threads)
      : space_(space),
        excerpts_(excerpts),
        free_(free),
        threads_(threads),
        parameters_(start),
        noise_(noise) {
    const Eigen::Index n2 = 2 * space.joints(), count = static_cast<Eigen::Index>(excerpts.size());
    variables_.resize(n2 * count + static_cast<Eigen::Index>(free.size()));
    for (Eigen::Index i = 0; i < count; ++i) variables_.segment(n2 * i, n2) = excerpts[i].start;
    for (std::size_t k = 0; k < free.size(); ++k) values()[k] = start[free[k]];
    robust_.resize(excerpts.size());
    for (std::size_t i = 0; i < excerpts.size(); ++i) robust_[i] = excerpts[i].weight;
    reduced.resize(excerpts.size());
    const Chain<double> chain = chain_from(space, start);
    longest_step_s_ =
        std::min(0.01, std::max(0.0006, stable_step(chain, excerpts[0].start.head(space.joints()))));
  }

  std::vector<Reduced> reduced;

  /// Of the free parameters.
  double* values() { return variables_.data() + variables_.size() - static_cast<Eigen::Index>(free_.size()); }
  /// Start of excerpt i.
  double* state(std::size_t i) { return variables_.data() + 2 * space_.joints() * i; }
  std::size_t count() const { return excerpts_.size(); }
  int free() const { return static_cast<int>(free_.size()); }

  /// Below it the integration would no longer follow the friction.
  double narrowest_width(int joint) const {
    const Chain<double> chain = chain_from(space_, parameters_);
    return std::max(1e-4, 0.5 * chain.friction[joint].width * longest_step_s_ /
                              stable_step(chain, excerpts_[0].start.head(space_.joints())));
  }

  int rows() const { return 2 * space_.joints() + static_cast<int>(free_.size()) + 1; }
  const Eigen::VectorXd& noise() const { return noise_; }

  Eigen::VectorXd parameters() const {
    Eigen::VectorXd p = parameters_;
    for (std::size_t k = 0; k < free_.size(); ++k) p[free_[k]] = variables_.tail(free_.size())[k];
    return p;
  }

  void PrepareForEvaluation(bool jacobians, bool) override {
    const SegmentModel model(space_, parameters(), free_, longest_step_s_);
    parallel_for(static_cast<int>(excerpts_.size()), threads_, [&](int i) { evaluate(model, i, jacobians); });
  }

  /// Residuals of all excerpts in units of measurement: [excerpt](2n x rows); NaN where nothing was measured.
  std::vector<Eigen::MatrixXd> residuals() const {
    std::vector<Eigen::MatrixXd> out(excerpts_.size());
    const SegmentModel model(space_, parameters(), free_, longest_step_s_);
    parallel_for(static_cast<int>(excerpts_.size()), threads_, [&](int i) {
      SegmentMotion motion;
      model.run(excerpts_[i], start_of(i), false, motion);
      out[i] = motion.state - excerpts_[i].measured;
      for (Eigen::Index k = 0; k < out[i].size(); ++k)
        if (excerpts_[i].weight(k) == 0.0) out[i](k) = std::numeric_limits<double>::quiet_NaN();
    });
    return out;
  }

  /// Weights every sample by its residual against `noise` from now on.
  void reweight(const std::vector<Eigen::MatrixXd>& residuals, const Eigen::VectorXd& noise) {
    noise_ = noise;
    for (std::size_t i = 0; i < excerpts_.size(); ++i)
      for (Eigen::Index k = 0; k < residuals[i].cols(); ++k)
        for (Eigen::Index c = 0; c < residuals[i].rows(); ++c) {
          const double u = std::abs(residuals[i](c, k)) / (kOutlierStd * noise[c]);
          robust_[i](c, k) = excerpts_[i].weight(c, k) > 0.0 ? (u > 1.0 ? 1.0 / (u * u) : 1.0) : 0.0;
        }
  }

  const std::vector<Eigen::MatrixXd>& robust() const { return robust_; }

 private:
  Eigen::VectorXd start_of(int i) const {
    return variables_.segment(2 * space_.joints() * i, 2 * space_.joints());
  }

  void evaluate(const SegmentModel& model, int i, bool jacobians) {
    const Excerpt& e = excerpts_[i];
    SegmentMotion motion;
    model.run(e, start_of(i), jacobians, motion);
    const int n2 = 2 * space_.joints(), width = n2 + static_cast<int>(free_.size());
    Eigen::MatrixXd stacked(n2 * e.rows(), jacobians ? width + 1 : 1);
    Eigen::Index used = 0;
    for (int k = 0; k < e.rows(); ++k)
      for (int c = 0; c < n2; ++c) {
        const double weight = std::sqrt(robust_[i](c, k)) / noise_[c];
        if (weight == 0.0) continue;
        double r = weight * (motion.state(c, k) - e.measured(c, k));
        if (!(std::abs(r) < kHuge)) r = kHuge;
        stacked(used, stacked.cols() - 1) = r;
        if (jacobians) stacked.row(used).head(width) = weight * motion.sensitivity.row(n2 * k + c);
        ++used;
      }
    store(reduced[i], stacked.topRows(used), jacobians);
  }

  void store(Reduced& out, const Eigen::Ref<const Eigen::MatrixXd>& stacked, bool jacobians) const {
    const int n2 = 2 * space_.joints();
    out.residual.setZero(rows());
    if (!jacobians) {
      out.residual[0] = stacked.norm();
      return;
    }
    Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(rows(), rows());
    if (stacked.allFinite()) {
      const Eigen::HouseholderQR<Eigen::MatrixXd> qr(stacked);
      const Eigen::Index height = std::min<Eigen::Index>(rows(), stacked.rows());
      factor.topRows(height) = qr.matrixQR().topRows(height).triangularView<Eigen::Upper>();
    }
    out.by_state = factor.leftCols(n2);
    out.by_parameter = factor.middleCols(n2, factor.cols() - n2 - 1);
    out.residual = factor.rightCols<1>();
  }

  const ParameterSpace& space_;
  const std::vector<Excerpt>& excerpts_;
  const std::vector<int>& free_;
  int threads_;
  double longest_step_s_ = 0.01;
  Eigen::VectorXd parameters_, noise_;
  /// All starts, then the values, in one piece of memory: Ceres orders blocks by address, and another order
  /// would round differently.
  Eigen::VectorXd variables_;
  std::vector<Eigen::MatrixXd> robust_;
};

/// Hands Ceres what the evaluation has prepared.
class ExcerptCost : public ceres::CostFunction {
 public:
  ExcerptCost(const Evaluation& evaluation, int excerpt, int states, int free)
      : evaluation_(evaluation), excerpt_(excerpt) {
    set_num_residuals(evaluation.rows());
    mutable_parameter_block_sizes()->push_back(states);
    mutable_parameter_block_sizes()->push_back(free);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    const Reduced& r = evaluation_.reduced[excerpt_];
    std::copy_n(r.residual.data(), r.residual.size(), residuals);
    if (!jacobians) return true;
    if (jacobians[0]) std::copy_n(r.by_state.data(), r.by_state.size(), jacobians[0]);
    if (jacobians[1]) std::copy_n(r.by_parameter.data(), r.by_parameter.size(), jacobians[1]);
    return true;
  }

 private:
  const Evaluation& evaluation_;
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

void build(ceres::Problem& problem, Evaluation& evaluation, const ParameterSpace& space,
           const std::vector<int>& free, const std::vector<ParameterPrior>& priors) {
  double* parameters = evaluation.values();
  const int count = static_cast<int>(free.size());
  for (std::size_t i = 0; i < evaluation.count(); ++i)
    problem.AddResidualBlock(new ExcerptCost(evaluation, static_cast<int>(i), 2 * space.joints(), count),
                             nullptr, evaluation.state(i), parameters);
  const auto index_of = [&](int p) {
    const auto it = std::find(free.begin(), free.end(), p);
    return it == free.end() ? -1 : static_cast<int>(it - free.begin());
  };
  for (const auto& prior : priors)
    if (const int k = index_of(prior.parameter); k >= 0)
      problem.AddResidualBlock(new PriorCost(k, prior.value, prior.std, count), nullptr, parameters);
  if (const int k = index_of(space.timing()); k >= 0) {
    problem.SetParameterLowerBound(parameters, k, -1.0);
    problem.SetParameterUpperBound(parameters, k, 2.0);
  }
  for (int j = 0; j < space.joints(); ++j)
    if (const int k = index_of(space.log_width(j)); k >= 0) {
      problem.SetParameterLowerBound(parameters, k, std::log(evaluation.narrowest_width(j)));
      problem.SetParameterUpperBound(parameters, k, std::log(0.5));
    }
}

ceres::Solver::Summary solve(ceres::Problem& problem, Evaluation& evaluation, int max_iterations, bool last) {
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
    auto middle = s.begin() + static_cast<std::ptrdiff_t>(s.size() / 2);
    std::nth_element(s.begin(), middle, s.end());
    const double cut = kOutlierStd * std::max(1.4826 * *middle, floor[c]);
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

/// Covariance of the free parameters when the residuals are white, by Ceres.
bool white_covariance(ceres::Problem& problem, Evaluation& evaluation, Eigen::MatrixXd& out) {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  const double* block = evaluation.values();
  const int n = evaluation.free();
  const std::vector<std::pair<const double*, const double*>> wanted = {{block, block}};
  if (!covariance.Compute(wanted, &problem)) return false;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> c(n, n);
  covariance.GetCovarianceBlock(block, block, c.data());
  out = 0.5 * (c + c.transpose());
  return out.allFinite();
}

/// Sandwich over blocks of about a second: what the residuals' own correlation says of the spread.
Eigen::MatrixXd sandwich(const Evaluation& evaluation, const std::vector<Excerpt>& excerpts,
                         const Eigen::MatrixXd& white) {
  const Eigen::Index m = white.rows();
  Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(m);
  double blocks = 0.0;
  for (std::size_t i = 0; i < excerpts.size(); ++i) {
    // At the optimum an excerpt's gradient with respect to its own start is zero: what is left is of the
    // parameters alone.
    g += evaluation.reduced[i].by_parameter.transpose() * evaluation.reduced[i].residual;
    const bool ends =
        i + 1 == excerpts.size() || excerpts[i + 1].log != excerpts[i].log ||
        std::floor(excerpts[i + 1].time[0] / kBlock_s) != std::floor(excerpts[i].time[0] / kBlock_s);
    if (!ends) continue;
    meat += g * g.transpose();
    g.setZero();
    blocks += 1.0;
  }
  const double correction = blocks / std::max(1.0, blocks - static_cast<double>(m));
  return correction * white * meat * white;
}

/// The white covariance with every std at least that of the sandwich.
Eigen::MatrixXd widen(const Eigen::MatrixXd& white, const Eigen::MatrixXd& robust, double& widened) {
  Eigen::VectorXd factor(white.rows());
  for (Eigen::Index k = 0; k < white.rows(); ++k)
    factor[k] = white(k, k) > 0.0 ? std::sqrt(std::max(1.0, robust(k, k) / white(k, k))) : 1.0;
  widened = factor.maxCoeff();
  return factor.asDiagonal() * white * factor.asDiagonal();
}

}  // namespace

ShootingFit fit_shooting(const ParameterSpace& space, const std::vector<Excerpt>& excerpts,
                         const Eigen::VectorXd& start, const std::vector<int>& free,
                         const std::vector<ParameterPrior>& priors, const Eigen::VectorXd& noise,
                         const Eigen::VectorXd& floor, const ShootingOptions& options,
                         const Progress& progress) {
  ShootingFit fit;
  fit.parameters = start;
  fit.noise = noise.cwiseMax(floor);
  fit.covariance.setZero(space.count(), space.count());
  fit.segments = static_cast<int>(excerpts.size());
  Evaluation evaluation(space, excerpts, start, free, fit.noise, options.threads);
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &evaluation;
  ceres::Problem problem(problem_options);
  build(problem, evaluation, space, free, priors);
  bool settled = false;
  ceres::Solver::Summary summary;
  while (fit.rounds < options.max_rounds) {
    if (progress) progress("identifying", static_cast<double>(fit.rounds) / options.max_rounds);
    summary = solve(problem, evaluation, options.max_iterations, settled);
    fit.iterations += static_cast<int>(summary.iterations.size()) - 1;
    ++fit.rounds;
    const auto residuals = evaluation.residuals();
    const Eigen::VectorXd next =
        measure_noise(residuals, excerpts, fit.noise, floor, static_cast<int>(free.size()));
    const bool was_settled = settled;
    settled = ((next - fit.noise).array().abs() <= kSettled * fit.noise.array()).all();
    fit.noise = next;
    fit.correlation = neighbour_correlation(residuals, next.size());
    if (was_settled) break;
    evaluation.reweight(residuals, next);
  }
  fit.parameters = evaluation.parameters();
  fit.converged = summary.termination_type == ceres::CONVERGENCE;
  fit.reason = fmt::format("{} iterations in {} rounds over {} segments; {}", fit.iterations, fit.rounds,
                           fit.segments, fit.converged ? "converged" : "stopped before convergence");
  evaluation.PrepareForEvaluation(true, true);
  Eigen::MatrixXd white;
  if (!white_covariance(problem, evaluation, white)) {
    fit.converged = false;
    fit.reason += "; the covariance is singular";
    return fit;
  }
  const Eigen::MatrixXd wide = widen(white, sandwich(evaluation, excerpts, white), fit.widened);
  for (std::size_t i = 0; i < free.size(); ++i)
    for (std::size_t k = 0; k < free.size(); ++k) fit.covariance(free[i], free[k]) = wide(i, k);
  return fit;
}

}  // namespace faultline
