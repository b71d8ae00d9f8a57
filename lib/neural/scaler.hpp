// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace faultline {

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
