// SPDX-License-Identifier: MIT
#include "lib/balance/regress.hpp"

#include <Eigen/Cholesky>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {

using Eigen::MatrixXd;
using Eigen::VectorXd;

NormalEquations normal_equations(const MatrixXd& columns, const VectorXd& rows) {
  NormalEquations out;
  out.matrix.setZero(columns.cols(), columns.cols());
  out.matrix.selfadjointView<Eigen::Lower>().rankUpdate(columns.transpose());
  out.matrix.triangularView<Eigen::StrictlyUpper>() = out.matrix.transpose();
  out.vector = columns.transpose() * rows;
  out.square = rows.squaredNorm();
  out.rows = static_cast<double>(rows.size());
  return out;
}

MatrixXd Regression::covariance() const { return covariance(0, estimate.size()); }

MatrixXd Regression::covariance(Eigen::Index first, Eigen::Index count) const {
  MatrixXd half = MatrixXd::Identity(estimate.size(), estimate.size()).middleCols(first, count);
  factor.triangularView<Eigen::Lower>().solveInPlace(half);
  return half.transpose() * half;
}

VectorXd Regression::std() const {
  MatrixXd half = MatrixXd::Identity(estimate.size(), estimate.size());
  factor.triangularView<Eigen::Lower>().solveInPlace(half);
  return half.colwise().norm().transpose();
}

MatrixXd posterior_factor(const MatrixXd& square, const VectorXd& precision, const MatrixXd& leading) {
  const Eigen::Index all = square.rows(), known = leading.rows(), rest = all - known;
  MatrixXd out(all, all);
  out.topLeftCorner(known, known) = leading;
  out.topRightCorner(known, rest).setZero();
  if (rest == 0) return out;
  MatrixXd across = square.topRightCorner(known, rest), last = square.bottomRightCorner(rest, rest);
  last.diagonal() += precision.tail(rest);
  if (known > 0) {
    leading.triangularView<Eigen::Lower>().solveInPlace(across);
    last.noalias() -= across.transpose() * across;
  }
  out.bottomLeftCorner(rest, known) = across.transpose();
  out.bottomRightCorner(rest, rest) = last.llt().matrixL();
  return out;
}

Regression regress(const NormalEquations& sums, const VectorXd& precision, const MatrixXd& leading) {
  Regression out;
  out.factor = posterior_factor(sums.matrix, precision, leading);
  out.estimate = sums.vector;
  out.factor.triangularView<Eigen::Lower>().solveInPlace(out.estimate);
  out.factor.triangularView<Eigen::Lower>().transpose().solveInPlace(out.estimate);
  double log_determinant = 0.0;  // of half the ratio of the prior's and the posterior's precision
  for (int i = 0; i < precision.size(); ++i)
    log_determinant += 0.5 * elementary::log(precision[i]) - elementary::log(out.factor(i, i));
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
