// SPDX-License-Identifier: MIT
#include "formats/csv_dialect.hpp"

#include <algorithm>
#include <map>

#include "formats/csv_fields.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

constexpr std::size_t kSampleLines = 300;

struct Line {
  std::size_t begin = 0, end = 0;  ///< bytes, end after the newline
  std::string_view text;
  bool comment = false;
  std::vector<std::string_view> fields{};
  int numbers = 0, texts = 0;
};

std::vector<Line> lines_of(std::string_view head) {
  std::vector<Line> lines;
  std::size_t begin = head.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
  while (begin < head.size() && lines.size() < kSampleLines) {
    const auto newline = head.find('\n', begin);
    const std::size_t end = newline == std::string_view::npos ? head.size() : newline + 1;
    Line line{begin, end, head.substr(begin, (newline == std::string_view::npos ? end : newline) - begin)};
    line.comment = is_comment_or_blank(line.text);
    lines.push_back(line);
    begin = end;
  }
  const bool cut = lines.size() > 2 && lines.back().end == head.size() && head.back() != '\n';
  if (cut) lines.pop_back();
  return lines;
}

void count_cells(Line& line, char separator, char decimal) {
  split_fields(line.text, separator, line.fields);
  line.numbers = line.texts = 0;
  for (const std::string_view field : line.fields) {
    const CellKind kind = read_cell(field, decimal).kind;
    line.numbers += kind == CellKind::number;
    line.texts += kind == CellKind::text;
  }
}

/// The most frequent number of fields; the larger one when two are equally frequent.
int usual_fields(const std::vector<Line>& lines) {
  std::map<int, int> frequency;
  for (const Line& line : lines)
    if (!line.comment) ++frequency[static_cast<int>(line.fields.size())];
  int best = 0, count = 0;
  for (const auto& [fields, times] : frequency)
    if (times >= count) best = fields, count = times;
  return best;
}

bool is_data(const Line& line, int fields) {
  return !line.comment && static_cast<int>(line.fields.size()) == fields && line.numbers > 0 &&
         2 * line.numbers >= line.texts;
}

double score(std::vector<Line>& lines, char separator, char decimal) {
  for (Line& line : lines)
    if (!line.comment) count_cells(line, separator, decimal);
  const int fields = usual_fields(lines);
  double sum = 0.0;
  int all_fields = 0;
  for (const Line& line : lines) {
    if (line.comment) continue;
    all_fields += static_cast<int>(line.fields.size());
    if (is_data(line, fields)) sum += line.numbers - 0.5 * line.texts;
  }
  return sum > 0.0 ? sum : 1e-6 * all_fields;
}

void choose_separator(std::vector<Line>& lines, CsvDialect& dialect) {
  double best = -1.0;
  for (const char separator : {',', ';', '\t', '|', ' '}) {
    for (const char decimal : {'.', ','}) {
      if (separator == decimal) continue;
      const double now = score(lines, separator, decimal);
      if (now > best) best = now, dialect.separator = separator, dialect.decimal = decimal;
    }
  }
  score(lines, dialect.separator, dialect.decimal);
}

/// A header behind a comment sign, as numpy.savetxt and rostopic write it.
bool take_commented_header(const Line& line, const CsvDialect& dialect, int fields,
                           std::vector<std::string>& names) {
  std::string_view text = without_blanks(line.text);
  while (!text.empty() && (text.front() == '#' || text.front() == '%')) text.remove_prefix(1);
  std::vector<std::string_view> parts;
  split_fields(text, dialect.separator, parts);
  if (static_cast<int>(parts.size()) != fields) return false;
  for (const std::string_view part : parts)
    if (read_cell(part, dialect.decimal).kind != CellKind::text) return false;
  names.assign(parts.begin(), parts.end());
  return true;
}

bool is_units_line(const Line& line, int fields) {
  if (line.comment || static_cast<int>(line.fields.size()) != fields) return false;
  for (const std::string_view field : line.fields) {
    std::string_view unit = field;
    if (unit.size() > 2 && (unit.front() == '[' || unit.front() == '('))
      unit = unit.substr(1, unit.size() - 2);
    if (!si_factor(unit)) return false;
  }
  return line.texts > 0;
}

bool could_be_header(const Line& line, int fields, bool last_data_cell_missing) {
  const int have = static_cast<int>(line.fields.size());
  return !line.comment && line.numbers == 0 && line.texts > 0 &&
         (have == fields || (have == fields - 1 && last_data_cell_missing && have > 1));
}

std::string unit_without_brackets(std::string_view unit) {
  if (unit.size() > 2 && (unit.front() == '[' || unit.front() == '(')) unit = unit.substr(1, unit.size() - 2);
  return std::string(unit);
}

/// Names and units by field, from the lines above the data; empty names when there is no header.
void find_header(const std::vector<Line>& lines, std::size_t data, int fields, CsvDialect& dialect,
                 std::vector<std::string>& names, std::vector<std::string>& units) {
  const bool open_end =
      data < lines.size() && read_cell(lines[data].fields.back(), '.').kind == CellKind::missing;
  std::size_t line = data;
  dialect.preamble_lines = 0;
  for (std::size_t i = data; i-- > 0;) {
    if (names.empty() && units.empty() && is_units_line(lines[i], fields) && i > 0 &&
        could_be_header(lines[i - 1], fields, open_end)) {
      for (const std::string_view unit : lines[i].fields) units.push_back(unit_without_brackets(unit));
      continue;
    }
    if (names.empty() && could_be_header(lines[i], fields, open_end)) {
      names.assign(lines[i].fields.begin(), lines[i].fields.end());
      line = i;
      continue;
    }
    dialect.preamble_lines += !lines[i].comment;
  }
  for (std::size_t i = data; i-- > 0 && names.empty();)
    if (lines[i].comment && take_commented_header(lines[i], dialect, fields, names)) line = i;
  dialect.has_header = line < data;
}

/// "name,value,name,value" rows, as `ros2 topic echo --csv` writes key-value statistics.
bool names_stand_in_rows(const Line& first, const Line* second, std::vector<std::string>& names) {
  int pairs = 0;
  std::vector<std::string> found(first.fields.size());
  for (std::size_t i = 0; i + 1 < first.fields.size(); ++i) {
    const bool name = read_cell(first.fields[i], '.').kind == CellKind::text;
    const bool same = !second || (i < second->fields.size() && second->fields[i] == first.fields[i]);
    if (!name || read_cell(first.fields[i + 1], '.').kind == CellKind::text) continue;
    if (!same) return false;
    found[i + 1] = std::string(first.fields[i]);
    ++pairs;
  }
  if (pairs < 3) return false;
  names = found;
  return true;
}

/// The first two fields of a row without header when they are seconds since 1970 and nanoseconds.
bool starts_with_stamp(const Line& line) {
  if (line.fields.size() < 3) return false;
  const Cell seconds = read_cell(line.fields[0], '.'), nanoseconds = read_cell(line.fields[1], '.');
  const bool whole = line.fields[0].find('.') == std::string_view::npos &&
                     line.fields[1].find('.') == std::string_view::npos;
  return whole && seconds.value > 1e9 && seconds.value < 4e9 && nanoseconds.value > 1e5 &&
         nanoseconds.value < 1e9;
}

void name_headless(const std::vector<Line>& lines, std::size_t data, CsvDialect& dialect,
                   std::vector<std::string>& names) {
  const Line* second = data + 1 < lines.size() ? &lines[data + 1] : nullptr;
  dialect.names_in_rows = names_stand_in_rows(lines[data], second, names);
  names.resize(lines[data].fields.size());
  if (starts_with_stamp(lines[data])) names[0] = "sec", names[1] = "nanosec";
}

void make_columns(const std::vector<std::string>& names, const std::vector<std::string>& units, int fields,
                  const Line* data, CsvDialect& dialect) {
  dialect.fields = fields;
  for (int i = 0; i < fields; ++i) {
    const std::string name = i < static_cast<int>(names.size()) ? names[i] : "";
    const bool missing = !data || read_cell(data->fields[i], dialect.decimal).kind == CellKind::missing;
    if (name.empty() && i == fields - 1 && missing && fields > 1)
      continue;  // a separator at the end of each row
    if (name.empty() && dialect.names_in_rows && read_cell(data->fields[i], '.').kind != CellKind::number)
      continue;
    const NameAndUnit parts = split_unit(name);
    RawColumn column{name.empty() ? "column" + std::to_string(i + 1) : parts.name, parts.unit};
    if (column.unit.empty() && i < static_cast<int>(units.size())) column.unit = units[i];
    if (column.name == "rosbagTimestamp") column.unit = "ns";
    dialect.columns.push_back(column);
    dialect.value_fields.push_back(i);
  }
  const bool rostopic = names.size() > 1 && names[0] == "time" && names[1].rfind("field.", 0) == 0;
  if (rostopic) dialect.columns[0].unit = "ns";
}

}  // namespace

CsvDialect find_dialect(std::string_view head) {
  CsvDialect dialect;
  auto lines = lines_of(head);
  choose_separator(lines, dialect);
  const int fields = usual_fields(lines);
  const auto at =
      std::find_if(lines.begin(), lines.end(), [&](const Line& line) { return is_data(line, fields); });
  std::size_t data = static_cast<std::size_t>(at - lines.begin());
  const bool has_data = data < lines.size();
  if (!has_data) {  // a header only, or text: the first line with the usual number of fields is the header
    for (data = 0; data < lines.size() &&
                   (lines[data].comment || static_cast<int>(lines[data].fields.size()) != fields);)
      ++data;
    data = std::min(data + 1, lines.size());
  }
  std::vector<std::string> names, units;
  std::vector<Line> above(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(data));
  if (has_data) above.push_back(lines[data]);
  find_header(above, data, fields, dialect, names, units);
  if (!dialect.has_header && has_data) name_headless(lines, data, dialect, names);
  make_columns(names, units, fields, has_data ? &lines[data] : nullptr, dialect);
  dialect.data_begin = data < lines.size() ? lines[data].begin : (lines.empty() ? 0 : lines.back().end);
  dialect.lines_before = static_cast<std::int64_t>(data);
  return dialect;
}

}  // namespace faultline
