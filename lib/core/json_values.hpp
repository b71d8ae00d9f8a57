// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

/// Values in JSON as in all files of faultline: a missing value is null, and a number that is not finite
/// (JSON has none) counts as missing. Results convert to both kinds of JSON.
namespace faultline {

nlohmann::ordered_json number_or_null(double value);
/// Returns a list in which each number that is not finite is null.
nlohmann::ordered_json numbers_or_null(const std::vector<double>& values);
/// Returns null for an empty text.
nlohmann::ordered_json text_or_null(const std::string& text);
/// Returns null unless `count` is at least 1: joints and rows count from 1, 0 is none.
nlohmann::ordered_json count_or_null(std::int64_t count);

/// Returns a list of render(item) for each item; `Json` is either kind.
template <typename Json, typename Items, typename Render>
Json list_of(const Items& items, Render render) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(Json(render(item)));
  return list;
}

// Inverse functions of those above; for any other value they throw what nlohmann::json throws.
double number_or_nan(const nlohmann::json& value);
double number_or_nan(const nlohmann::ordered_json& value);
std::string text_or_empty(const nlohmann::ordered_json& value);
int count_or_zero(const nlohmann::ordered_json& value);

inline constexpr int kMostJsonNesting = 64;  ///< lists and objects within one another

/// Throws Error(input) if a JSON text nests deeper than that. To be called before parsing a text whose values
/// are converted, which uses the stack for each level.
void refuse_deep_json(std::string_view json, const std::string& where);

/// Members that a JSON object must have. These functions throw Error(input), which names `where` and the key,
/// if the key is missing or its value has another type than requested; a number must be finite.
const nlohmann::json& member_of(const nlohmann::json& object, const char* key, const std::string& where);
double number_from_json(const nlohmann::json& object, const char* key, const std::string& where);
std::string text_from_json(const nlohmann::json& object, const char* key, const std::string& where);
bool flag_from_json(const nlohmann::json& object, const char* key, const std::string& where);
/// Returns a whole number from 1 to a million.
int count_from_json(const nlohmann::json& object, const char* key, const std::string& where);

/// The same for a value itself; `key` is for the message.
double checked_number(const nlohmann::json& value, const char* key, const std::string& where);
const nlohmann::json& checked_list(const nlohmann::json& value, const char* key, const std::string& where);

}  // namespace faultline
