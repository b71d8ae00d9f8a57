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
  for (const int a : some) {
    gain_ += columns[a] * covariance_.col(a);
    predicted += columns[a] * estimate_[a];
  }
  for (const int a : some) variance += columns[a] * gain_[a];
  const double innovation = row - predicted;
  square_ += innovation * innovation / variance;
  estimate_ += innovation / variance * gain_;
  for (Eigen::Index a = 0; a < gain_.size(); ++a)
    if (gain_[a] != 0.0) covariance_.col(a) -= gain_[a] / variance * gain_;
}

}  // namespace faultline
