// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/ceres.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lib/core/parallel.hpp"
#include "lib/identify/segment_model.hpp"

namespace faultline {

inline constexpr double kShootingOutlierStd = 4.0;
inline constexpr double kDiverged = 1e6;  ///< residual that stands for a motion that diverged

/// What one excerpt adds to the problem, reduced to a triangular factor: same cost, gradient and Gauss-Newton
/// matrix as its thousands of rows.
struct ReducedExcerpt {
  Eigen::VectorXd residual;                                                         ///< 2n + free + 1
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_state;  ///< (2n + free + 1) x 2n
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_parameter;
};

/// The problem's variables and what they give, excerpt by excerpt in parallel, in an order that does not
/// depend on the number of threads.
class ShootingEvaluation : public ceres::EvaluationCallback {
 public:
  ShootingEvaluation(const ParameterSpace& space, const std::vector<Excerpt>& excerpts,
                     const Eigen::VectorXd& start, const std::vector<int>& free, const Eigen::VectorXd& noise,
                     int threads)
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

  std::vector<ReducedExcerpt> reduced;

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
          const double u = std::abs(residuals[i](c, k)) / (kShootingOutlierStd * noise[c]);
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
        if (!(std::abs(r) < kDiverged)) r = kDiverged;
        stacked(used, stacked.cols() - 1) = r;
        if (jacobians) stacked.row(used).head(width) = weight * motion.sensitivity.row(n2 * k + c);
        ++used;
      }
    store(reduced[i], stacked.topRows(used), jacobians);
  }

  void store(ReducedExcerpt& out, const Eigen::Ref<const Eigen::MatrixXd>& stacked, bool jacobians) const {
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

}  // namespace faultline
