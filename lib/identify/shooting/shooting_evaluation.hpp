// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lib/identify/shooting/segment_model.hpp"
#include "lib/identify/shooting/shooting.hpp"

namespace faultline {

/// Standard deviations of the noise beyond which a sample's weight falls with the square of its residual.
inline constexpr double kShootingOutlierStd = 4.0;

/// Contribution of one excerpt to the problem, reduced to a triangular factor: same cost, gradient and
/// Gauss-Newton matrix as its thousands of rows.
struct ReducedExcerpt {
  Eigen::VectorXd residual;                                                         ///< 2n + free + 1
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_state;  ///< (2n + free + 1) x 2n
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_parameter;
};

/// Variables of the problem and their residuals and derivatives, computed excerpt by excerpt in parallel;
/// independent of the number of threads.
class ShootingEvaluation : public ceres::EvaluationCallback {
 public:
  explicit ShootingEvaluation(const ShootingProblem& problem);

  std::vector<ReducedExcerpt> reduced;

  /// Returns the values of the free parameters.
  double* values() { return variables_.data() + variables_.size() - static_cast<Eigen::Index>(free_.size()); }
  /// Returns the start of excerpt i.
  double* state(std::size_t i) { return variables_.data() + 2 * space_.joints() * i; }
  std::size_t count() const { return excerpts_.size(); }
  int rows() const { return 2 * space_.joints() + static_cast<int>(free_.size()) + 1; }

  /// Returns the width below which the integration would no longer follow the friction, rad/s or m/s.
  double narrowest_width(int j) const;
  Eigen::VectorXd parameters() const;
  void PrepareForEvaluation(bool jacobians, bool new_point) override;
  /// Returns the residuals of all excerpts in measured units: [excerpt](2n x rows); NaN if not measured.
  std::vector<Eigen::MatrixXd> residuals() const;
  /// Weights every sample by its residual over `noise` from now on.
  void reweight(const std::vector<Eigen::MatrixXd>& residuals, const Eigen::VectorXd& noise);

 private:
  JointVector largest_torque() const;
  Eigen::VectorXd start_of(int i) const;
  void evaluate(const SegmentModel& model, int i, bool jacobians);
  /// Stores the triangular factor of `stacked`, which it destroys.
  void store(ReducedExcerpt& out, Eigen::MatrixXd& stacked, bool jacobians) const;

  const ParameterSpace& space_;
  std::span<const Excerpt> excerpts_;
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
