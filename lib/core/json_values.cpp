// SPDX-License-Identifier: MIT
#include "lib/core/json_values.hpp"

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

}  // namespace faultline
