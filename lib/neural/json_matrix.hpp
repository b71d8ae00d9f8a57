// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>

/// Members of JSON objects with errors that name `where` and the key: Error(input) when the key is missing or
/// not of the kind asked for, or when a number is missing or not finite. Numbers keep every bit both ways.
namespace faultline {

nlohmann::json vector_to_json(const Eigen::VectorXd& values);
/// A list of rows.
nlohmann::json matrix_to_json(const Eigen::MatrixXd& values);

const nlohmann::json& member_of(const nlohmann::json& object, const char* key, const std::string& where);
double number_from_json(const nlohmann::json& object, const char* key, const std::string& where);
std::string text_from_json(const nlohmann::json& object, const char* key, const std::string& where);
Eigen::VectorXd vector_from_json(const nlohmann::json& object, const char* key, const std::string& where);
Eigen::MatrixXd matrix_from_json(const nlohmann::json& object, const char* key, const std::string& where);

}  // namespace faultline
