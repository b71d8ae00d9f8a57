// SPDX-License-Identifier: MIT
#include "formats/csv/csv_fields.hpp"

#include <cctype>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "formats/csv/clock_text.hpp"
#include "formats/csv/wide_rows.hpp"
#include "lib/log/raw_reader.hpp"

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

constexpr std::size_t kSampleLines = 300;

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

Cell read_cell(std::string_view text, char decimal, bool day_first) {
  text = without_quotes(text);
  if (means_missing(text)) return {CellKind::missing, kNan};
  if (equals_ignoring_case(text, "true")) return {CellKind::number, 1.0};
  if (equals_ignoring_case(text, "false")) return {CellKind::number, 0.0};
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  if (read_number(text.data(), text.data() + text.size(), decimal, value)) return {CellKind::number, value};
  if (const auto clock = read_clock(text, day_first)) return {CellKind::number, clock->seconds};
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

std::vector<CsvLine> lines_of(std::string_view head) {
  std::vector<CsvLine> lines;
  std::size_t begin = head.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
  while (begin < head.size() && lines.size() < kSampleLines) {
    const auto newline = head.find('\n', begin);
    const std::size_t end = newline == std::string_view::npos ? head.size() : newline + 1;
    CsvLine line{begin, end, head.substr(begin, (newline == std::string_view::npos ? end : newline) - begin)};
    line.comment = is_comment_or_blank(line.text);
    lines.push_back(line);
    begin = end;
  }
  const bool cut = lines.size() > 2 && lines.back().end == head.size() && head.back() != '\n';
  if (cut) lines.pop_back();
  return lines;
}

void count_cells(CsvLine& line, char separator, char decimal) {
  split_fields(line.text, separator, line.fields);
  line.numbers = line.texts = 0;
  for (const std::string_view field : line.fields) {
    CellKind kind = read_cell(field, decimal).kind;
    if (kind == CellKind::text) kind = read_cell(field, decimal, true).kind;  // a date with the day first
    line.numbers += kind == CellKind::number;
    line.texts += kind == CellKind::text;
  }
}

int usual_fields(const std::vector<CsvLine>& lines) {
  std::map<int, int> frequency;
  for (const CsvLine& line : lines)
    if (!line.comment) ++frequency[static_cast<int>(line.fields.size())];
  int best = 0, count = 0;
  for (const auto& [fields, times] : frequency)
    if (times >= count) best = fields, count = times;
  return best;
}

bool is_data(const CsvLine& line, int fields) {
  return !line.comment && static_cast<int>(line.fields.size()) == fields && line.numbers > 0 &&
         2 * line.numbers >= line.texts;
}

}  // namespace faultline
