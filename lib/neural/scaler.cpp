// SPDX-License-Identifier: MIT
#include "lib/neural/scaler.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

/// A relative spread below this is rounding error.
constexpr double kNoSpread = 1e-12;

double factor_for(double half_spread, double size) {
  return half_spread > kNoSpread * std::max(std::fabs(size), 1e-300) ? 1.0 / half_spread : 1.0;
}

}  // namespace

Eigen::MatrixXd Scaler::apply(const Eigen::Ref<const Eigen::MatrixXd>& values) const {
  return ((values.colwise() - offset).array().colwise() * factor.array()).matrix();
}

Eigen::MatrixXd Scaler::invert(const Eigen::Ref<const Eigen::MatrixXd>& scaled) const {
  return ((scaled.array().colwise() / factor.array()).matrix()).colwise() + offset;
}

Scaler range_scaler(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  const Eigen::VectorXd low = values.rowwise().minCoeff(), high = values.rowwise().maxCoeff();
  Scaler scaler{0.5 * (low + high), Eigen::VectorXd(values.rows())};
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    scaler.factor[i] = factor_for(0.5 * (high[i] - low[i]), scaler.offset[i]);
  return scaler;
}

Scaler standard_scaler(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  Scaler scaler{values.rowwise().mean(), Eigen::VectorXd(values.rows())};
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const double deviation = std::sqrt((values.row(i).array() - scaler.offset[i]).square().mean());
    scaler.factor[i] = factor_for(deviation, scaler.offset[i]);
  }
  return scaler;
}

}  // namespace faultline
