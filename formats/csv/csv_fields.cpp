// SPDX-License-Identifier: MIT
#include "formats/csv/csv_fields.hpp"

#include <fast_float/fast_float.h>

#include <cctype>
#include <string>

#include "formats/csv/clock_cell.hpp"
#include "formats/missing.hpp"

namespace faultline {
namespace {

constexpr std::string_view kBlanks = " \t\r";

bool equals_ignoring_case(std::string_view text, std::string_view lower) {
  if (text.size() != lower.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (std::tolower(static_cast<unsigned char>(text[i])) != lower[i]) return false;
  return true;
}

bool means_missing(std::string_view text) {
  for (const char* word : {"", "nan", "-nan", "null", "none", "na", "n/a", "-", "#n/a"})
    if (equals_ignoring_case(text, word)) return true;
  return false;
}

std::string_view without_quotes(std::string_view text) {
  text = without_blanks(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    return without_blanks(text.substr(1, text.size() - 2));
  return text;
}

}  // namespace

std::string_view without_blanks(std::string_view text) {
  const auto begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

bool is_comment_or_blank(std::string_view line) {
  line = without_blanks(line);
  return line.empty() || line.front() == '#' || line.front() == '%';
}

Cell read_cell(std::string_view text, char decimal) {
  text = without_quotes(text);
  if (means_missing(text)) return {CellKind::missing, kNan};
  if (equals_ignoring_case(text, "true")) return {CellKind::number, 1.0};
  if (equals_ignoring_case(text, "false")) return {CellKind::number, 0.0};
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const fast_float::parse_options options(fast_float::chars_format::general, decimal);
  const auto [end, error] =
      fast_float::from_chars_advanced(text.data(), text.data() + text.size(), value, options);
  if (error == std::errc() && end == text.data() + text.size()) return {CellKind::number, value};
  if (const auto seconds = clock_seconds(text)) return {CellKind::number, *seconds};
  return {CellKind::text, kNan};
}

void split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  if (separator == ' ') line = without_blanks(line);
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    const bool full = fields.size() == static_cast<std::size_t>(kMostFields);
    const bool cut = i == line.size() ||
                     (!quoted && !full && (line[i] == separator || (separator == ' ' && line[i] == '\t')));
    if (!cut) continue;
    fields.push_back(without_quotes(line.substr(begin, i - begin)));
    if (separator == ' ')
      while (i + 1 < line.size() && (line[i + 1] == ' ' || line[i + 1] == '\t')) ++i;
    begin = i + 1;
  }
}

}  // namespace faultline
