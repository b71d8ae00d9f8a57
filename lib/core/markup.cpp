// SPDX-License-Identifier: MIT
#include "lib/core/markup.hpp"

#include <algorithm>

#include "lib/core/text.hpp"
#include "lib/core/utf8.hpp"

namespace faultline {
namespace {

/// Returns null for a character that needs no escape.
const char* entity(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&apos;";
    case '\n':
      return "&#10;";
    case '\t':
      return "&#9;";
    default:
      return nullptr;
  }
}

}  // namespace

std::string escaped_markup(std::string_view text) {
  const std::string valid = valid_utf8(text);
  std::string escaped;
  for (std::size_t i = 0; i < valid.size();) {
    const std::size_t command = command_length(valid, i);
    if (const char* name = entity(valid[i]))
      escaped += name;
    else
      escaped += command > 0 ? '?' : valid[i];
    i += std::max<std::size_t>(command, 1);
  }
  return escaped;
}

}  // namespace faultline
