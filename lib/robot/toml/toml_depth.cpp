// SPDX-License-Identifier: MIT
#include "lib/robot/toml/toml_depth.hpp"

#include <algorithm>

namespace faultline {
namespace {

/// Returns the position after the quoted text that begins at `at`. A quote that is not closed ends with its
/// line, an open triple quote with the text.
std::size_t after_quotes(std::string_view toml, std::size_t at) {
  const char quote = toml[at];
  const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
  const bool long_text = toml.substr(at, 3) == three;
  for (at += long_text ? 3 : 1; at < toml.size(); ++at) {
    if (toml[at] == '\\' && quote == '"') {
      ++at;
    } else if (long_text && toml.substr(at, 3) == three) {
      at += 3;
      for (int i = 0; i < 2 && at < toml.size() && toml[at] == quote; ++i)
        ++at;  // belongs to the text, before the closing quotes
      return at;
    } else if (!long_text && (toml[at] == quote || toml[at] == '\n')) {
      return at + (toml[at] == quote);
    }
  }
  return toml.size();
}

DeepPlace place_of(std::string_view toml, std::size_t at) {
  const std::string_view before = toml.substr(0, at);
  const auto line_begin = before.rfind('\n') + 1;  // 0 if there is no line break before
  return {static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
          static_cast<int>(at - line_begin) + 1};
}

}  // namespace

std::optional<DeepPlace> too_deep(std::string_view toml) {
  int open = 0, dots = 0;
  for (std::size_t at = 0; at < toml.size();) {
    const char c = toml[at];
    if (c == '"' || c == '\'') {
      at = after_quotes(toml, at);
      continue;
    }
    if (c == '#') {
      at = std::min(toml.find('\n', at), toml.size());
      continue;
    }
    if (c == '[' || c == '{') ++open;
    if (c == ']' || c == '}') open = std::max(open - 1, 0);
    if (c == '.') ++dots;
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}') dots = 0;
    if (open > kMostTomlNesting || dots > kMostTomlNesting) return place_of(toml, at);
    ++at;
  }
  return std::nullopt;
}

}  // namespace faultline
