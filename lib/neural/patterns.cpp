// SPDX-License-Identifier: MIT
#include "lib/neural/patterns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

Patterns columns(const Patterns& patterns, const std::vector<int>& chosen) {
  return {patterns.inputs(Eigen::all, chosen), patterns.targets(Eigen::all, chosen)};
}

void check_finite(const Eigen::MatrixXd& values, const char* what, const char* where) {
  for (Eigen::Index column = 0; column < values.cols(); ++column)
    for (Eigen::Index row = 0; row < values.rows(); ++row)
      if (!std::isfinite(values(row, column)))
        throw Error(
            ErrorCode::input, where,
            fmt::format("{} {} of pattern {} is not finite; leave such patterns out", what, row, column));
}

/// A relative spread below 1e-12 is rounding error.
double factor_for(double half_spread, double size) {
  return half_spread > 1e-12 * std::max(std::fabs(size), 1e-300) ? 1.0 / half_spread : 1.0;
}

}  // namespace

void shuffle(std::vector<int>& order, Random& random) {
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
}

PatternSplit split_patterns(const Patterns& patterns, double validation_share, std::uint64_t seed) {
  std::vector<int> order(patterns.count());
  std::iota(order.begin(), order.end(), 0);
  Random random(seed);
  shuffle(order, random);
  const auto held_back =
      order.begin() + std::lround(std::clamp(validation_share, 0.0, 1.0) * patterns.count());
  std::vector<int> validation(order.begin(), held_back), training(held_back, order.end());
  std::sort(validation.begin(), validation.end());
  std::sort(training.begin(), training.end());
  return {columns(patterns, training), columns(patterns, validation)};
}

void check_patterns(const Patterns& patterns, int inputs, int outputs, const char* where) {
  if (patterns.count() == 0) throw Error(ErrorCode::input, where, "there are no patterns to learn from");
  if (patterns.targets.cols() != patterns.inputs.cols())
    throw Error(ErrorCode::input, where,
                fmt::format("{} input columns but {} target columns", patterns.inputs.cols(),
                            patterns.targets.cols()));
  if ((inputs >= 0 && patterns.inputs.rows() != inputs) ||
      (outputs >= 0 && patterns.targets.rows() != outputs))
    throw Error(ErrorCode::input, where,
                fmt::format("patterns have {} inputs and {} targets, expected {} and {}",
                            patterns.inputs.rows(), patterns.targets.rows(), inputs, outputs));
  check_finite(patterns.inputs, "input", where);
  check_finite(patterns.targets, "target", where);
}

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
