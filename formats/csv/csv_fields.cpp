// SPDX-License-Identifier: MIT
#include "formats/csv/csv_fields.hpp"

#include <cctype>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "formats/csv/wide_rows.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr int kHours = 24, kSixty = 60, kMonths = 12, kDays = 31;

/// Takes parts from the front of a text; sets `ok` to false if one is missing.
struct ClockText {
  std::string_view rest;
  bool ok = true;

  int digits(std::size_t count) {
    int value = 0;
    if (rest.size() < count) return ok = false, 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (rest[i] < '0' || rest[i] > '9') return ok = false, 0;
      value = 10 * value + (rest[i] - '0');
    }
    rest.remove_prefix(count);
    return value;
  }
  bool takes(char c) {
    if (rest.empty() || rest.front() != c) return false;
    rest.remove_prefix(1);
    return true;
  }
  void demand(char c) { ok = takes(c) && ok; }

  /// Reads hh:mm:ss; returns seconds. The second may be 60 (leap second).
  std::int64_t time_of_day() {
    const int hours = digits(2);
    demand(':');
    const int minutes = digits(2);
    demand(':');
    const int seconds = digits(2);
    ok = ok && hours < kHours && minutes < kSixty && seconds <= kSixty;
    return (std::int64_t{hours} * kSixty + minutes) * kSixty + seconds;
  }
  /// Reads the digits after a decimal sign, if there is one; returns nanoseconds, truncated.
  std::int64_t nanoseconds() {
    if (!takes('.') && !takes(',')) return 0;
    std::int64_t value = 0, scale = 1'000'000'000;
    const std::size_t before = rest.size();
    for (; !rest.empty() && rest.front() >= '0' && rest.front() <= '9'; rest.remove_prefix(1)) {
      if (scale == 1) continue;
      scale /= 10;
      value += scale * (rest.front() - '0');
    }
    ok = ok && rest.size() < before;
    return value;
  }
  /// Reads the time zone; returns seconds east of UTC.
  std::int64_t zone() {
    if (rest.empty() || takes('Z') || takes('z')) return 0;
    const bool west = takes('-');
    if (!west) demand('+');
    const int hours = digits(2);
    takes(':');
    const int minutes = rest.empty() ? 0 : digits(2);
    return (west ? -1 : 1) * (std::int64_t{hours} * kSixty + minutes) * kSixty;
  }
};

std::int64_t days_after_1970(int year, int month, int day) {
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                            std::chrono::day(static_cast<unsigned>(day))};
  return sys_days(date).time_since_epoch().count();
}

/// Converts a date and time in ISO 8601 ("2026-05-01T12:30:00.125+02:00", also with a blank for the T, a
/// decimal comma, or no zone = UTC) to seconds since 1970, or a time of day ("12:30:00.125") to seconds since
/// midnight; nullopt for any other text.
std::optional<double> clock_seconds(std::string_view text) {
  constexpr std::size_t kShortest = 8;  // hh:mm:ss
  if (text.size() < kShortest) return std::nullopt;
  ClockText clock{text};
  std::int64_t seconds = 0;
  const bool dated = text[4] == '-';
  if (dated) {
    const int year = clock.digits(4);
    clock.demand('-');
    const int month = clock.digits(2);
    clock.demand('-');
    const int day = clock.digits(2);
    clock.ok = clock.ok && (clock.takes('T') || clock.takes('t') || clock.takes(' ')) && month >= 1 &&
               month <= kMonths && day >= 1 && day <= kDays;
    if (!clock.ok) return std::nullopt;
    seconds = days_after_1970(year, month, day) * kHours * kSixty * kSixty;
  }
  seconds += clock.time_of_day();
  const std::int64_t nanoseconds = clock.nanoseconds();
  if (dated) seconds -= clock.zone();
  if (!clock.ok || !clock.rest.empty()) return std::nullopt;
  return static_cast<double>(seconds) + static_cast<double>(nanoseconds) / 1e9;
}

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

Cell read_cell(std::string_view text, char decimal) {
  text = without_quotes(text);
  if (means_missing(text)) return {CellKind::missing, kNan};
  if (equals_ignoring_case(text, "true")) return {CellKind::number, 1.0};
  if (equals_ignoring_case(text, "false")) return {CellKind::number, 0.0};
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  if (read_number(text.data(), text.data() + text.size(), decimal, value)) return {CellKind::number, value};
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
    const CellKind kind = read_cell(field, decimal).kind;
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
