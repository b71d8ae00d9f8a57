// SPDX-License-Identifier: MIT
#include "lib/core/outgoing/json_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "lib/core/text.hpp"

namespace faultline {
namespace {

/// Returns the code point of the character whose UTF-8 has these bytes, one to three.
unsigned code_point(std::string_view bytes) {
  const auto bits = [&](std::size_t i) { return static_cast<unsigned>(bytes[i]) & 0x3fU; };
  if (bytes.size() == 1) return static_cast<unsigned char>(bytes[0]);
  if (bytes.size() == 2) return (bits(0) & 0x1fU) << 6U | bits(1);
  return (bits(0) & 0x0fU) << 12U | bits(1) << 6U | bits(2);
}

}  // namespace

std::string inert_json(const std::string& json) {
  std::string inert;
  inert.reserve(json.size());
  for (std::size_t i = 0; i < json.size();) {
    const std::size_t command = json[i] == '\n' ? 0 : command_length(json, i);
    if (command > 0)
      inert += fmt::format("\\u{:04x}", code_point(std::string_view(json).substr(i, command)));
    else
      inert += json[i];
    i += std::max<std::size_t>(command, 1);
  }
  return inert;
}

std::string json_text(const nlohmann::ordered_json& json) {
  return inert_json(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) + "\n";
}

std::string inside_script(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

}  // namespace faultline
