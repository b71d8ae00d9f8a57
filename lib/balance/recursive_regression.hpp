// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace faultline {

/// Regression of regress() while its rows arrive one after the other: the estimate after each row costs
/// columns^2 operations instead of columns^3 (recursive least squares; Plackett 1950).
class RecursiveRegression {
 public:
  /// `precision` is the inverse prior variance of each parameter; all are above 0.
  explicit RecursiveRegression(const Eigen::VectorXd& precision);

  /// Adds a whitened row of unit variance. `columns` are those of the parameters `some`; the others are 0.
  void add(const Eigen::Ref<const Eigen::VectorXd>& columns, const std::vector<int>& some, double row);

  const Eigen::VectorXd& estimate() const { return estimate_; }
  /// Sum of the squared residuals of the rows so far at the present estimate, plus the term of the prior.
  double square() const { return square_; }

 private:
  Eigen::VectorXd estimate_, gain_;
  Eigen::MatrixXd covariance_;
  double square_ = 0.0;
};

}  // namespace faultline
