// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace faultline {

/// Sums of a linear regression with whitened rows of unit variance: all that its estimate needs of the rows.
struct NormalEquations {
  Eigen::MatrixXd matrix;  ///< X' X
  Eigen::VectorXd vector;  ///< X' y
  double square = 0.0;     ///< y' y
  double rows = 0.0;
};

NormalEquations normal_equations(const Eigen::MatrixXd& columns, const Eigen::VectorXd& rows);

/// Result of a linear regression with a Gaussian prior of mean zero (equation (5) of docs/how-it-works.md;
/// Bishop 2006, section 3.5).
struct Regression {
  Eigen::VectorXd estimate;
  Eigen::MatrixXd factor;  ///< posterior_factor()
  /// ln p(rows) without -rows / 2 ln(2 pi), parameters integrated out: the evidence for these columns.
  double log_likelihood = 0.0;
  double left = 0.0;  ///< sum of squared residuals, without the prior's term

  Eigen::MatrixXd covariance() const;
  /// Returns the standard deviation of each parameter.
  Eigen::VectorXd std() const;
  /// Returns the covariance of the parameters `first` to `first` + `count` - 1.
  Eigen::MatrixXd covariance(Eigen::Index first, Eigen::Index count) const;
};

/// Returns the lower Cholesky factor of the posterior's inverse covariance X' X + diag(precision). `leading`
/// is the factor of its leading block, if known: regressions that share their first columns then cost
/// columns^2 instead of columns^3 operations.
Eigen::MatrixXd posterior_factor(const Eigen::MatrixXd& square, const Eigen::VectorXd& precision,
                                 const Eigen::MatrixXd& leading = {});

/// Solves the regression. `precision` is the inverse prior variance of each parameter; all are above 0.
/// `leading`: as for posterior_factor().
Regression regress(const NormalEquations& sums, const Eigen::VectorXd& precision,
                   const Eigen::MatrixXd& leading = {});

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
