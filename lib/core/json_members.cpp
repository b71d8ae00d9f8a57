// SPDX-License-Identifier: MIT
#include "lib/core/json_members.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& where, const char* key, const std::string& what) {
  throw Error(ErrorCode::input, where, fmt::format("{}: expected {}", key, what));
}

}  // namespace

const json& member_of(const json& object, const char* key, const std::string& where) {
  if (!object.is_object() || !object.contains(key))
    throw Error(ErrorCode::input, where, fmt::format("key \"{}\" is missing", key));
  return object.at(key);
}

double checked_number(const json& value, const char* key, const std::string& where) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    refuse(where, key, "a finite number, found " + value.dump());
  return value.get<double>();
}

const json& checked_list(const json& value, const char* key, const std::string& where) {
  if (!value.is_array()) refuse(where, key, "a list");
  return value;
}

double number_from_json(const json& object, const char* key, const std::string& where) {
  return checked_number(member_of(object, key, where), key, where);
}

std::string text_from_json(const json& object, const char* key, const std::string& where) {
  const json& value = member_of(object, key, where);
  if (!value.is_string()) refuse(where, key, "a text");
  return value.get<std::string>();
}

bool flag_from_json(const json& object, const char* key, const std::string& where) {
  const json& value = member_of(object, key, where);
  if (!value.is_boolean()) refuse(where, key, "true or false");
  return value.get<bool>();
}

int count_from_json(const json& object, const char* key, const std::string& where) {
  constexpr std::int64_t kMost = 1000000;
  const json& value = member_of(object, key, where);
  if (!value.is_number_integer() || value.get<std::int64_t>() < 1 || value.get<std::int64_t>() > kMost)
    refuse(where, key, "a whole number of at least 1");
  return value.get<int>();
}

}  // namespace faultline
