// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace faultline {

/// Training data of a network, one column for each pattern.
struct Patterns {
  Eigen::MatrixXd inputs;   ///< inputs x patterns
  Eigen::MatrixXd targets;  ///< outputs x patterns

  int count() const { return static_cast<int>(inputs.cols()); }
};

struct PatternSplit {
  Patterns training;
  Patterns validation;
};

/// Draws `validation_share` (0 to 1) of the patterns for validation, at random by `seed`; keeps their order.
PatternSplit split_patterns(const Patterns& patterns, double validation_share, std::uint64_t seed = 1);

/// Throws Error(input) if there are no patterns, if the counts of inputs and targets or the expected sizes
/// (inputs, outputs; -1 = any) disagree, or if a number is not finite; `where` names the origin of the
/// patterns.
void check_patterns(const Patterns& patterns, int inputs, int outputs, const char* where);

}  // namespace faultline
