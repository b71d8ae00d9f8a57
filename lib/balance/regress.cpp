// SPDX-License-Identifier: MIT
#include "lib/balance/regress.hpp"

#include "lib/core/elementary/elementary.hpp"

namespace faultline {

using Eigen::VectorXd;

NormalEquations normal_equations(const Eigen::MatrixXd& columns, const Eigen::VectorXd& rows) {
  NormalEquations out;
  out.matrix.setZero(columns.cols(), columns.cols());
  out.matrix.selfadjointView<Eigen::Lower>().rankUpdate(columns.transpose());
  out.matrix.triangularView<Eigen::StrictlyUpper>() = out.matrix.transpose();
  out.vector = columns.transpose() * rows;
  out.square = rows.squaredNorm();
  out.rows = static_cast<double>(rows.size());
  return out;
}

Eigen::MatrixXd Regression::covariance() const {
  return factor.solve(Eigen::MatrixXd::Identity(estimate.size(), estimate.size()));
}

Eigen::MatrixXd Regression::covariance(Eigen::Index first, Eigen::Index count) const {
  Eigen::MatrixXd out(count, count);
  for (Eigen::Index k = 0; k < count; ++k)
    out.col(k) = factor.solve(Eigen::VectorXd::Unit(estimate.size(), first + k)).segment(first, count);
  return out;
}

Regression regress(const NormalEquations& sums, const Eigen::VectorXd& precision) {
  Regression out;
  Eigen::MatrixXd posterior = sums.matrix;
  posterior.diagonal() += precision;
  out.factor.compute(posterior);
  out.estimate = out.factor.solve(sums.vector);
  double log_determinant = 0.0;  // of half the ratio of the prior's and the posterior's precision
  for (int i = 0; i < precision.size(); ++i)
    log_determinant += 0.5 * elementary::log(precision[i]) - elementary::log(out.factor.matrixLLT()(i, i));
  const double explained = out.estimate.dot(sums.vector);
  out.left = sums.square - 2.0 * explained + out.estimate.dot(sums.matrix * out.estimate);
  out.log_likelihood = -0.5 * (sums.square - explained) + log_determinant;
  return out;
}

RecursiveRegression::RecursiveRegression(const VectorXd& precision)
    : estimate_(VectorXd::Zero(precision.size())),
      gain_(precision.size()),
      covariance_(precision.cwiseInverse().asDiagonal()) {}

void RecursiveRegression::add(const Eigen::Ref<const VectorXd>& columns, const std::vector<int>& some,
                              double row) {
  gain_.setZero();
  double predicted = 0.0, variance = 1.0;
  for (Eigen::Index i = 0; i < columns.size(); ++i) {
    gain_ += columns[i] * covariance_.col(some[i]);
    predicted += columns[i] * estimate_[some[i]];
  }
  for (Eigen::Index i = 0; i < columns.size(); ++i) variance += columns[i] * gain_[some[i]];
  const double innovation = row - predicted;
  square_ += innovation * innovation / variance;
  estimate_ += innovation / variance * gain_;
  for (Eigen::Index a = 0; a < gain_.size(); ++a)
    if (gain_[a] != 0.0) covariance_.col(a) -= gain_[a] / variance * gain_;
}

}  // namespace faultline
