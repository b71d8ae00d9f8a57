// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace faultline {

/// The regression of regress() while its rows come in one after the other: the estimate after each row costs
/// columns^2 operations instead of columns^3 (recursive least squares; Plackett 1950).
class RecursiveRegression {
 public:
  /// `precision` is the inverse prior variance of each parameter; all are above 0.
  explicit RecursiveRegression(const Eigen::VectorXd& precision);

  /// Takes in a white row of unit variance. Of its columns only those listed in `some` are not 0.
  void add(const Eigen::Ref<const Eigen::VectorXd>& columns, const std::vector<int>& some, double row);

  const Eigen::VectorXd& estimate() const { return estimate_; }
  /// Squares that the estimate leaves of the rows so far, with those of the prior.
  double square() const { return square_; }

 private:
  Eigen::VectorXd estimate_, gain_;
  Eigen::MatrixXd covariance_;
  double square_ = 0.0;
};

}  // namespace faultline
