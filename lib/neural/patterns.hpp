// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace faultline {

/// What a network learns from, a pattern a column.
struct Patterns {
  Eigen::MatrixXd inputs;   ///< inputs x patterns
  Eigen::MatrixXd targets;  ///< outputs x patterns

  int count() const { return static_cast<int>(inputs.cols()); }
};

struct PatternSplit {
  Patterns training;
  Patterns validation;
};

/// Draws `validation_share` (0 to 1) of the patterns for validation, at random by `seed`; order is kept.
PatternSplit split_patterns(const Patterns& patterns, double validation_share, std::uint64_t seed = 1);

/// Throws Error(input) when there are no patterns, when the counts of inputs and targets or the sizes
/// expected (inputs, outputs; -1 = any) disagree, or when a number is not finite; `where` says whose patterns
/// they are.
void check_patterns(const Patterns& patterns, int inputs, int outputs, const char* where);

}  // namespace faultline
