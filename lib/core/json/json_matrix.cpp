// SPDX-License-Identifier: MIT
#include "lib/core/json/json_matrix.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

using nlohmann::json;

}  // namespace

json vector_to_json(const Eigen::VectorXd& values) {
  return json(std::vector<double>(values.begin(), values.end()));
}

json matrix_to_json(const Eigen::MatrixXd& values) {
  json rows = json::array();
  for (Eigen::Index r = 0; r < values.rows(); ++r) rows.push_back(vector_to_json(values.row(r)));
  return rows;
}

Eigen::VectorXd vector_from_json(const json& object, const char* key, const std::string& where) {
  const json& list = checked_list(member_of(object, key, where), key, where);
  Eigen::VectorXd values(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) values[i] = checked_number(list[i], key, where);
  return values;
}

Eigen::MatrixXd matrix_from_json(const json& object, const char* key, const std::string& where) {
  const json& rows = checked_list(member_of(object, key, where), key, where);
  const std::size_t width = rows.empty() ? 0 : checked_list(rows[0], key, where).size();
  Eigen::MatrixXd values(rows.size(), width);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (checked_list(rows[r], key, where).size() != width)
      throw Error(
          ErrorCode::input, where,
          fmt::format("{}: row {} has {} numbers, the first has {}", key, r + 1, rows[r].size(), width));
    for (std::size_t c = 0; c < width; ++c) values(r, c) = checked_number(rows[r][c], key, where);
  }
  return values;
}

}  // namespace faultline
