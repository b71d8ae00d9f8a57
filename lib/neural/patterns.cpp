// SPDX-License-Identifier: MIT
#include "lib/neural/patterns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/core/random.hpp"

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

}  // namespace

PatternSplit split_patterns(const Patterns& patterns, double validation_share, std::uint64_t seed) {
  std::vector<int> order(patterns.count());
  std::iota(order.begin(), order.end(), 0);
  Random random(seed);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
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

}  // namespace faultline
