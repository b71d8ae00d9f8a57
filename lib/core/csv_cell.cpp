// SPDX-License-Identifier: MIT
#include "lib/core/csv_cell.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "lib/core/text.hpp"

namespace faultline {
namespace {

bool is_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size();
}

/// Whether a formula could begin behind a semicolon, which some spreadsheets use as a separator.
bool begins_cell_inside(std::string_view text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == ';' && begins_like_formula(text.substr(i + 1))) return true;
  return false;
}

/// Adds an apostrophe before text that a spreadsheet would run.
std::string with_apostrophe(const std::string& text) {
  return begins_like_formula(text) && !is_number(text) ? "'" + text : text;
}

}  // namespace

bool begins_like_formula(std::string_view text) {
  return !text.empty() && std::string_view("=+-@").find(text[0]) != std::string_view::npos;
}

std::string inert_text(const std::string& text) { return with_apostrophe(printable(text)); }

std::string csv_cell(const std::string& text) {
  const std::string line = with_apostrophe(outgoing(text, false));
  if (line.find_first_of(",\"\n") == std::string::npos && !begins_cell_inside(line)) return line;
  std::string quoted = "\"";
  for (const char c : line) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string csv_joint(Joint joint) { return joint.is_none() ? "" : fmt::format("{}", joint); }

}  // namespace faultline
