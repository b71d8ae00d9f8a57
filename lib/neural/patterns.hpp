// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lib/core/random.hpp"

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

/// Puts the numbers into a random order.
void shuffle(std::vector<int>& order, Random& random);

/// Draws `validation_share` (0 to 1) of the patterns for validation, at random by `seed`; keeps their order.
PatternSplit split_patterns(const Patterns& patterns, double validation_share, std::uint64_t seed = 1);

/// Throws Error(input) if there are no patterns, if the counts of inputs and targets or the expected sizes
/// (inputs, outputs; -1 = any) disagree, or if a number is not finite; `where` names the origin of the
/// patterns.
void check_patterns(const Patterns& patterns, int inputs, int outputs, const char* where);

/// Scaled = (value - offset) * factor for each row. A constant row has factor 1, so that it scales to 0.
struct Scaler {
  Eigen::VectorXd offset;
  Eigen::VectorXd factor;

  int size() const { return static_cast<int>(offset.size()); }
  /// `values` and the result are size() x samples.
  Eigen::MatrixXd apply(const Eigen::Ref<const Eigen::MatrixXd>& values) const;
  Eigen::MatrixXd invert(const Eigen::Ref<const Eigen::MatrixXd>& scaled) const;
};

/// Scales the range of the values to [-1, 1] (the paper's normalisation to half range).
Scaler range_scaler(const Eigen::Ref<const Eigen::MatrixXd>& values);
/// Scales to mean 0 and standard deviation 1.
Scaler standard_scaler(const Eigen::Ref<const Eigen::MatrixXd>& values);

void to_json(nlohmann::json& json, const Scaler& scaler);
/// Throws Error(input) if a number is missing or a factor is 0; `where` names the file.
Scaler scaler_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace faultline
