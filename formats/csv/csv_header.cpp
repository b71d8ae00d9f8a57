// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "formats/csv/csv_dialect.hpp"
#include "formats/csv/csv_fields.hpp"
#include "lib/core/csv_cell.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

/// Reads a header after a comment sign, as numpy.savetxt and rostopic write it; false if the line is none.
bool take_commented_header(const CsvLine& line, const CsvDialect& dialect, int fields,
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

std::string_view unit_without_brackets(std::string_view unit) {
  return unit.size() > 2 && (unit.front() == '[' || unit.front() == '(') ? unit.substr(1, unit.size() - 2)
                                                                         : unit;
}

bool is_units_line(const CsvLine& line, int fields) {
  if (line.comment || static_cast<int>(line.fields.size()) != fields) return false;
  for (const std::string_view field : line.fields)
    if (!si_factor(unit_without_brackets(field))) return false;
  return line.texts > 0;
}

bool could_be_header(const CsvLine& line, int fields, bool last_data_cell_missing) {
  const int have = static_cast<int>(line.fields.size());
  return !line.comment && line.numbers == 0 && line.texts > 0 &&
         (have == fields || (have == fields - 1 && last_data_cell_missing && have > 1));
}

/// Names and units by field; no names when there is no header.
struct Header {
  std::vector<std::string> names, units;
};

/// Adds groups from the line above the names, such as "Joint 1,,Joint 2,", if names repeat. Each group
/// extends to the next one. True when the line has groups.
bool add_groups(const CsvLine& above, std::vector<std::string>& names) {
  const std::set<std::string> different(names.begin(), names.end());
  if (different.size() == names.size() || above.comment || above.fields.size() != names.size()) return false;
  if (above.numbers > 0 || above.texts == 0) return false;
  std::string group;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!above.fields[i].empty()) group = std::string(above.fields[i]);
    if (!group.empty()) names[i] = group + " " + names[i];
  }
  return true;
}

/// Finds the header in the lines above the rows.
Header find_header(std::span<const CsvLine> above, bool open_end, int fields, CsvDialect& dialect) {
  Header header;
  std::size_t line = above.size();
  dialect.preamble_lines = 0;
  for (std::size_t i = above.size(); i-- > 0;) {
    if (header.names.empty() && header.units.empty() && is_units_line(above[i], fields) && i > 0 &&
        could_be_header(above[i - 1], fields, open_end)) {
      for (const std::string_view unit : above[i].fields)
        header.units.emplace_back(unit_without_brackets(unit));
      continue;
    }
    if (header.names.empty() && could_be_header(above[i], fields, open_end)) {
      header.names.assign(above[i].fields.begin(), above[i].fields.end());
      line = i;
      continue;
    }
    dialect.preamble_lines += !above[i].comment;
  }
  for (std::size_t i = above.size(); i-- > 0 && header.names.empty();)
    if (above[i].comment && take_commented_header(above[i], dialect, fields, header.names)) line = i;
  dialect.has_header = line < above.size();
  if (dialect.has_header && line > 0 && add_groups(above[line - 1], header.names)) --dialect.preamble_lines;
  return header;
}

/// Finds "name,value,name,value" rows, as `ros2 topic echo --csv` writes key-value statistics.
bool names_stand_in_rows(const CsvLine& first, const CsvLine* second, std::vector<std::string>& names) {
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

/// True when a row without header begins with whole seconds since 1970 and nanoseconds.
bool starts_with_stamp(const CsvLine& line) {
  if (line.fields.size() < 3) return false;
  const Cell seconds = read_cell(line.fields[0], '.'), nanoseconds = read_cell(line.fields[1], '.');
  const bool whole = line.fields[0].find('.') == std::string_view::npos &&
                     line.fields[1].find('.') == std::string_view::npos;
  return whole && seconds.value > 1e9 && seconds.value < 4e9 && nanoseconds.value < 1e9 &&
         (nanoseconds.value > 1e5 ||
          (nanoseconds.value >= 0.0 && read_cell(line.fields[2], '.').kind != CellKind::number));
}

/// Names the fields of `ros2 topic echo --csv` of a JointState: stamp, frame, names, then the numbers of each
/// joint.
void name_joint_states(const CsvLine& row, std::vector<std::string>& names) {
  constexpr std::size_t kNamesBegin = 3;
  std::size_t joints = 0;
  while (kNamesBegin + joints < row.fields.size() &&
         read_cell(row.fields[kNamesBegin + joints], '.').kind == CellKind::text)
    ++joints;
  if (joints == 0 || row.fields.size() != kNamesBegin + 4 * joints) return;
  const char* arrays[] = {"q", "dq", "tau"};
  for (std::size_t a = 0; a < std::size(arrays); ++a)
    for (std::size_t j = 0; j < joints; ++j)
      names[kNamesBegin + (a + 1) * joints + j] =
          fmt::format("{}{}", arrays[a], Joint::at(static_cast<int>(j)));
}

void name_headless(std::span<const CsvLine> rows, CsvDialect& dialect, std::vector<std::string>& names) {
  const CsvLine* second = rows.size() > 1 ? &rows[1] : nullptr;
  dialect.names_in_rows = names_stand_in_rows(rows[0], second, names);
  names.resize(rows[0].fields.size());
  if (!starts_with_stamp(rows[0])) return;
  names[0] = "sec", names[1] = "nanosec";
  if (!dialect.names_in_rows) name_joint_states(rows[0], names);
}

/// Removes the apostrophe that keeps a spreadsheet from executing a name, see inert_text().
std::string without_apostrophe(const std::string& name) {
  const bool inert = name[0] == '\'' && begins_like_formula(std::string_view(name).substr(1));
  return inert ? name.substr(1) : name;
}

void make_columns(const Header& header, int fields, const CsvLine* row, CsvDialect& dialect) {
  const auto& [names, units] = header;
  dialect.fields = fields;
  for (int i = 0; i < fields; ++i) {
    const std::string name = i < static_cast<int>(names.size()) ? without_apostrophe(names[i]) : "";
    const bool missing = !row || read_cell(row->fields[i], dialect.decimal).kind == CellKind::missing;
    if (name.empty() && i == fields - 1 && missing && fields > 1)
      continue;  // a separator at the end of each row
    if (name.empty() && dialect.names_in_rows && row &&
        read_cell(row->fields[i], '.').kind != CellKind::number)
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

void find_columns(std::span<const CsvLine> above, std::span<const CsvLine> rows, int fields,
                  CsvDialect& dialect) {
  const bool open_end = !rows.empty() && read_cell(rows[0].fields.back(), '.').kind == CellKind::missing;
  Header header = find_header(above, open_end, fields, dialect);
  if (!dialect.has_header && !rows.empty()) name_headless(rows, dialect, header.names);
  make_columns(header, fields, rows.empty() ? nullptr : &rows[0], dialect);
  find_time(rows, dialect);
}

bool repeats_header(const CsvDialect& dialect, const std::vector<std::string_view>& fields) {
  if (!dialect.has_header || dialect.columns.empty()) return false;
  for (std::size_t i = 0; i < dialect.columns.size(); ++i) {
    const std::size_t field = static_cast<std::size_t>(dialect.value_fields[i]);
    if (field >= fields.size()) return false;
    const std::string& name = dialect.columns[i].name;
    if (fields[field].substr(0, name.size()) != name) return false;
  }
  return read_cell(fields[dialect.value_fields[0]], dialect.decimal).kind == CellKind::text;
}

}  // namespace faultline
