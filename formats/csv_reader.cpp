// SPDX-License-Identifier: MIT
#include "formats/csv_reader.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>

#include "formats/csv_dialect.hpp"
#include "formats/csv_fields.hpp"
#include "formats/line_buffer.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// What to do with a line that is no plain row of numbers.
enum class RowVerdict { keep, skip, drop };

class CsvReader : public RawReader {
 public:
  explicit CsvReader(std::unique_ptr<ByteSource> bytes);

  const std::vector<RawColumn>& columns() const override { return dialect_.columns; }
  void want(const std::vector<bool>& columns) override;
  bool next(RawBlock& block, int max_rows) override;
  void rewind() override;
  const LogIdentity& identity() const override { return identity_; }
  const Issues& issues() const override { return issues_; }
  double share_read() const override { return bytes_->share_read(); }

 private:
  void refuse_duplicates() const;
  void start();
  void prepare(RawBlock& block, int max_rows);
  const char* read_plain_row(const char* p, int row);
  RowVerdict read_any_row(std::string_view line, bool open_end, int row);
  RowVerdict judge_length(std::string_view line, bool open_end);
  void read_cells(int row);
  bool repeats_header() const;
  void report_text(std::string_view cell, int field);
  void report_row(const char* code, const std::string& what, bool dropped);
  void flush_text_counts();
  std::string place() const { return fmt::format("row {} (line {})", row_number_ + 1, line_number_ + 1); }

  std::unique_ptr<ByteSource> bytes_;
  CsvDialect dialect_;
  LineBuffer lines_;
  std::vector<int> column_of_field_;   ///< -1 for a field that is not wanted
  std::vector<double*> field_values_;  ///< of the block that is being filled; null for a field not wanted
  std::vector<std::string_view> fields_;
  std::vector<std::int64_t> text_cells_;  ///< of each column, not yet in issues_ but known to it
  std::int64_t row_number_ = 0;           ///< data rows before the present one
  std::int64_t line_number_ = 0;          ///< lines before the present one
  LogIdentity identity_;
  Issues issues_;
};

CsvReader::CsvReader(std::unique_ptr<ByteSource> bytes)
    : bytes_(std::move(bytes)), dialect_(find_dialect(bytes_->head())), lines_(*bytes_) {
  identity_.path = bytes_->path();
  identity_.format = "csv";
  refuse_duplicates();
  want(std::vector<bool>(dialect_.columns.size(), true));
  start();
}

void CsvReader::refuse_duplicates() const {
  std::map<std::string, int> seen;
  for (std::size_t i = 0; i < dialect_.columns.size(); ++i) {
    const int field = dialect_.value_fields[i] + 1;
    const auto [before, fresh] = seen.emplace(dialect_.columns[i].name, field);
    if (!fresh)
      throw Error(ErrorCode::input, bytes_->path(),
                  fmt::format("has two columns named \"{}\", the {}. and the {}.; give each its own name",
                              before->first, before->second, field));
  }
}

void CsvReader::want(const std::vector<bool>& columns) {
  column_of_field_.assign(dialect_.fields, -1);
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i]) column_of_field_[dialect_.value_fields[i]] = static_cast<int>(i);
}

/// Reads past the header and notes what was met on the way.
void CsvReader::start() {
  row_number_ = 0;
  line_number_ = dialect_.lines_before;
  text_cells_.assign(dialect_.columns.size(), 0);
  std::size_t to_skip = dialect_.data_begin;
  while (to_skip > 0 && lines_.fill()) {
    const std::size_t there = static_cast<std::size_t>(lines_.end_of_lines() - lines_.position());
    const std::size_t now = std::min(to_skip, there);
    lines_.advance_to(lines_.position() + now);
    to_skip -= now;
  }
  if (dialect_.preamble_lines > 0)
    issues_.add({"preamble_skipped", "", Severity::note, "lines before the table were left out", 0, kNan,
                 dialect_.preamble_lines});
  if (dialect_.names_in_rows)
    issues_.add(
        {"names_in_rows", "", Severity::note,
         "there is no header; each value has its name before it, and these were taken as column names"});
  else if (!dialect_.has_header)
    issues_.add(
        {"no_header", "", Severity::warning,
         "there is no header; columns are called column1, column2 and so on. Say what they are in the robot "
         "file, such as [log.columns] q1 = {name = \"column2\"}"});
}

void CsvReader::rewind() {
  bytes_->rewind();
  lines_.clear();
  issues_ = {};
  identity_.rows_read = 0;
  start();
}

void CsvReader::prepare(RawBlock& block, int max_rows) {
  block.columns.resize(dialect_.columns.size());
  field_values_.assign(dialect_.fields, nullptr);
  for (int field = 0; field < dialect_.fields; ++field) {
    const int column = column_of_field_[field];
    if (column < 0) continue;
    block.columns[column].resize(max_rows);
    field_values_[field] = block.columns[column].data();
  }
  block.first_row = row_number_;
}

bool CsvReader::next(RawBlock& block, int max_rows) {
  prepare(block, max_rows);
  int row = 0;
  while (row < max_rows && lines_.fill()) {
    const char* p = lines_.position();
    const char* const end = lines_.end_of_lines();
    bool stop = false;
    while (row < max_rows && p < end && !stop) {
      const char* after = read_plain_row(p, row);
      RowVerdict verdict = RowVerdict::keep;
      if (!after) {
        const char* newline =
            static_cast<const char*>(std::memchr(p, '\n', static_cast<std::size_t>(end - p)));
        after = newline + 1;
        verdict = read_any_row({p, static_cast<std::size_t>(newline - p)},
                               lines_.last_line_was_open() && after == end, row);
      }
      p = after;
      ++line_number_;
      row_number_ += verdict != RowVerdict::skip;
      row += verdict == RowVerdict::keep;
      if (verdict == RowVerdict::drop) {
        if (row == 0) block.first_row = row_number_;
        stop = row > 0;  // rows of a block follow each other
      }
    }
    lines_.advance_to(p);
    if (stop) break;
  }
  flush_text_counts();
  identity_.rows_read = row_number_;
  identity_.sha256 = bytes_->sha256();
  block.rows = row;
  for (auto& column : block.columns)
    if (!column.empty()) column.resize(row);
  return row > 0;
}

/// A row of nothing but numbers and separators; null when it is anything else and must be read with care.
const char* CsvReader::read_plain_row(const char* p, int row) {
  const char* const end = lines_.end_of_lines();
  const char separator = dialect_.separator;
  const bool blanks = separator == ' ';
  const fast_float::parse_options options(fast_float::chars_format::general, dialect_.decimal);
  const int fields = dialect_.fields;
  for (int field = 0; field < fields; ++field) {
    while (*p == ' ' || (blanks && *p == '\t')) ++p;
    if (double* values = field_values_[field]) {
      const auto [after, error] = fast_float::from_chars_advanced(p, end, values[row], options);
      if (error != std::errc()) return nullptr;
      p = after;
    } else {
      while (*p != separator && *p != '\n' && *p != '"' && !(blanks && *p == '\t')) ++p;
    }
    if (field + 1 == fields) break;
    if (*p != separator && !(blanks && *p == '\t')) return nullptr;
    ++p;
  }
  while (*p == ' ' || *p == '\r') ++p;
  return *p == '\n' ? p + 1 : nullptr;
}

RowVerdict CsvReader::read_any_row(std::string_view line, bool open_end, int row) {
  if (is_comment_or_blank(line)) return RowVerdict::skip;
  split_fields(line, dialect_.separator, fields_);
  if (repeats_header()) {
    report_row("header_repeated", "repeats the header; the line was left out, as where files were joined",
               false);
    return RowVerdict::skip;
  }
  const RowVerdict verdict = judge_length(line, open_end);
  if (verdict == RowVerdict::keep) read_cells(row);
  return verdict;
}

RowVerdict CsvReader::judge_length(std::string_view line, bool open_end) {
  const int have = static_cast<int>(fields_.size());
  const std::string start = fmt::format("has {} fields where {} are expected: \"{}\"", have, dialect_.fields,
                                        std::string(line.substr(0, 60)));
  if (have < dialect_.fields && open_end) {
    report_row("truncated_last_line", start + "; the file was cut here and the row was left out", true);
    return RowVerdict::drop;
  }
  if (have < dialect_.fields)
    report_row("ragged_row", start + "; the fields at its end are taken as missing", false);
  bool surplus = false;
  for (int i = dialect_.fields; i < have; ++i) surplus = surplus || !fields_[i].empty();
  if (!surplus) return RowVerdict::keep;
  report_row("row_too_long", start + "; which value is which is not sure, so the row was left out", true);
  return RowVerdict::drop;
}

void CsvReader::read_cells(int row) {
  for (int field = 0; field < dialect_.fields; ++field) {
    double* values = field_values_[field];
    if (!values) continue;
    const bool there = field < static_cast<int>(fields_.size());
    const Cell cell = there ? read_cell(fields_[field], dialect_.decimal) : Cell{CellKind::missing, kNan};
    values[row] = cell.value;
    if (cell.kind == CellKind::text) report_text(fields_[field], field);
  }
}

bool CsvReader::repeats_header() const {
  if (!dialect_.has_header || dialect_.columns.empty()) return false;
  for (std::size_t i = 0; i < dialect_.columns.size(); ++i) {
    const std::size_t field = static_cast<std::size_t>(dialect_.value_fields[i]);
    if (field >= fields_.size()) return false;
    const std::string& name = dialect_.columns[i].name;
    if (fields_[field].substr(0, name.size()) != name) return false;
  }
  return read_cell(fields_[dialect_.value_fields[0]], dialect_.decimal).kind == CellKind::text;
}

void CsvReader::report_text(std::string_view cell, int field) {
  const int column = column_of_field_[field];
  const std::string& name = dialect_.columns[column].name;
  if (issues_.find("not_a_number", name)) {
    ++text_cells_[column];
    return;
  }
  issues_.add({"not_a_number", name, Severity::warning,
               fmt::format("{}, column {} \"{}\": \"{}\" is no number; taken as missing", place(), field + 1,
                           name, std::string(cell.substr(0, 40))),
               row_number_ + 1});
}

void CsvReader::report_row(const char* code, const std::string& what, bool dropped) {
  issues_.add({code, "", Severity::warning, place() + " " + what, row_number_ + 1, kNan, 1, dropped ? 1 : 0});
}

void CsvReader::flush_text_counts() {
  for (std::size_t i = 0; i < text_cells_.size(); ++i) {
    if (text_cells_[i] == 0) continue;
    issues_.add({"not_a_number", dialect_.columns[i].name, Severity::warning, "", 0, kNan, text_cells_[i]});
    text_cells_[i] = 0;
  }
}

}  // namespace

bool looks_like_csv(std::string_view head) {
  const bool utf16 = head.substr(0, 2) == "\xFF\xFE" || head.substr(0, 2) == "\xFE\xFF";
  return !utf16 && head.find('\0') == std::string_view::npos;
}

std::unique_ptr<RawReader> open_csv(std::unique_ptr<ByteSource> bytes) {
  return std::make_unique<CsvReader>(std::move(bytes));
}

}  // namespace faultline
