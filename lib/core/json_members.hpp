// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

/// Members that a JSON object must have. Error(input), which names `where` and the key, when the key is
/// missing or its value is not of the kind asked for; a number must be finite.
namespace faultline {

const nlohmann::json& member_of(const nlohmann::json& object, const char* key, const std::string& where);
double number_from_json(const nlohmann::json& object, const char* key, const std::string& where);
std::string text_from_json(const nlohmann::json& object, const char* key, const std::string& where);
bool flag_from_json(const nlohmann::json& object, const char* key, const std::string& where);
/// A whole number from 1 to a million.
int count_from_json(const nlohmann::json& object, const char* key, const std::string& where);

/// The same of a value itself; `key` is for the message.
double checked_number(const nlohmann::json& value, const char* key, const std::string& where);
const nlohmann::json& checked_list(const nlohmann::json& value, const char* key, const std::string& where);

}  // namespace faultline
