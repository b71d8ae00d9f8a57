// SPDX-License-Identifier: MIT
#include "lib/core/json_values.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

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

}  // namespace faultline
