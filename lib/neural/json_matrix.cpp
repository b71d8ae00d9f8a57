// SPDX-License-Identifier: MIT
#include "lib/neural/json_matrix.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

using nlohmann::json;

double finite_number(const json& value, const char* key, const std::string& where) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw Error(ErrorCode::input, where,
                fmt::format("{}: expected a finite number, found {}", key, value.dump()));
  return value.get<double>();
}

const json& list_of(const json& value, const char* key, const std::string& where) {
  if (!value.is_array()) throw Error(ErrorCode::input, where, fmt::format("{}: expected a list", key));
  return value;
}

}  // namespace

json vector_to_json(const Eigen::VectorXd& values) {
  return json(std::vector<double>(values.begin(), values.end()));
}

json matrix_to_json(const Eigen::MatrixXd& values) {
  json rows = json::array();
  for (Eigen::Index r = 0; r < values.rows(); ++r) rows.push_back(vector_to_json(values.row(r)));
  return rows;
}

const json& member_of(const json& object, const char* key, const std::string& where) {
  if (!object.is_object() || !object.contains(key))
    throw Error(ErrorCode::input, where, fmt::format("key \"{}\" is missing", key));
  return object.at(key);
}

double number_from_json(const json& object, const char* key, const std::string& where) {
  return finite_number(member_of(object, key, where), key, where);
}

std::string text_from_json(const json& object, const char* key, const std::string& where) {
  const json& value = member_of(object, key, where);
  if (!value.is_string()) throw Error(ErrorCode::input, where, fmt::format("{}: expected a text", key));
  return value.get<std::string>();
}

Eigen::VectorXd vector_from_json(const json& object, const char* key, const std::string& where) {
  const json& list = list_of(member_of(object, key, where), key, where);
  Eigen::VectorXd values(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) values[i] = finite_number(list[i], key, where);
  return values;
}

Eigen::MatrixXd matrix_from_json(const json& object, const char* key, const std::string& where) {
  const json& rows = list_of(member_of(object, key, where), key, where);
  const std::size_t width = rows.empty() ? 0 : list_of(rows[0], key, where).size();
  Eigen::MatrixXd values(rows.size(), width);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (list_of(rows[r], key, where).size() != width)
      throw Error(
          ErrorCode::input, where,
          fmt::format("{}: row {} has {} numbers, the first has {}", key, r + 1, rows[r].size(), width));
    for (std::size_t c = 0; c < width; ++c) values(r, c) = finite_number(rows[r][c], key, where);
  }
  return values;
}

}  // namespace faultline
