// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

/// Members that a JSON object must have. The functions throw Error(input), which names `where` and the key,
/// if the key is missing or its value has another type than requested; a number must be finite.
namespace faultline {

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
