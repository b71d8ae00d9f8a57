// SPDX-License-Identifier: MIT
#include "lib/balance/recursive_regression.hpp"

namespace faultline {

using Eigen::VectorXd;

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
