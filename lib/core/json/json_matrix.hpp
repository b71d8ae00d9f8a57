// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lib/core/json_values.hpp"

/// Vectors and matrices as JSON without loss of a bit both ways; members are read as by number_from_json().
namespace faultline {

nlohmann::json vector_to_json(const Eigen::VectorXd& values);
/// A list of rows.
nlohmann::json matrix_to_json(const Eigen::MatrixXd& values);

Eigen::VectorXd vector_from_json(const nlohmann::json& object, const char* key, const std::string& where);
Eigen::MatrixXd matrix_from_json(const nlohmann::json& object, const char* key, const std::string& where);

}  // namespace faultline
