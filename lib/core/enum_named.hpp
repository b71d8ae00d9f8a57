// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>

namespace faultline {

/// Returns the value of `all` for which to_string() gives `name`; nullopt for none.
template <typename Enum>
std::optional<Enum> enum_named(std::string_view name, std::initializer_list<Enum> all) {
  for (const Enum value : all)
    if (name == to_string(value)) return value;
  return std::nullopt;
}

}  // namespace faultline
