// SPDX-License-Identifier: MIT
#include "lib/core/json_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

template <typename AnyJson>
double number_in(const AnyJson& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.template get<double>();
}

using nlohmann::json;

[[noreturn]] void refuse(const std::string& where, const char* key, const std::string& what) {
  throw Error(ErrorCode::input, where, fmt::format("{}: expected {}", key, what));
}

}  // namespace

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json numbers_or_null(const std::vector<double>& values) { return list_of<Json>(values, number_or_null); }

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json count_or_null(std::int64_t count) { return count > 0 ? Json(count) : Json(nullptr); }

double number_or_nan(const nlohmann::json& value) { return number_in(value); }
double number_or_nan(const Json& value) { return number_in(value); }

std::string text_or_empty(const Json& value) { return value.is_null() ? "" : value.get<std::string>(); }

int count_or_zero(const Json& value) { return value.is_null() ? 0 : value.get<int>(); }

void refuse_deep_json(std::string_view json, const std::string& where) {
  int open = 0;
  bool quoted = false;
  for (std::size_t at = 0; at < json.size(); ++at) {
    const char c = json[at];
    if (quoted && c == '\\') {
      ++at;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && (c == '[' || c == '{')) {
      if (++open > kMostJsonNesting)
        throw Error(ErrorCode::input, where,
                    "nests lists and objects more deeply than " + std::to_string(kMostJsonNesting) +
                        " levels, unlike any file of faultline; restore it or create it again");
    } else if (!quoted && (c == ']' || c == '}')) {
      --open;
    }
  }
}

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
