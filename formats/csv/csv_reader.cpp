// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/byte_source.hpp"
#include "formats/csv/csv_dialect.hpp"
#include "formats/csv/csv_fields.hpp"
#include "formats/csv/csv_row.hpp"
#include "formats/csv/scope_export.hpp"
#include "formats/csv/wide_rows.hpp"
#include "formats/known_formats.hpp"
#include "formats/parts/joined_reader.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

/// Largest number of values of a block, for any number of columns: 8 MiB.
constexpr int kBlockValues = 1 << 20;
/// Number of fields missing at the ends of rows from which on their share is tested.
constexpr std::int64_t kMostAbsent = 1 << 26;
constexpr double kMostAbsentShare = 0.9;
/// Work of any line, also one that is no row.
constexpr std::int64_t kLineWork_ns = 200;

constexpr std::size_t kLongestHeadLine = 1 << 20;  ///< bytes; 16384 names of 64 characters
constexpr std::size_t kLongestLine = 1 << 24;      ///< bytes
constexpr std::size_t kBlock = 1 << 18;            ///< bytes that are read at once
constexpr std::size_t kKeptBefore = 1 << 12;       ///< bytes of the lines before

/// Whole lines of a text file in a window of bounded size, with kNumberMargin bytes around them. A newline is
/// added to a last line without one.
class LineBuffer {
 public:
  explicit LineBuffer(ByteSource& bytes) : bytes_(bytes) {}

  /// Whole lines from `position()` on, each ended by '\n'; empty when fill() must be called.
  const char* position() const { return text() + begin_; }
  const char* end_of_lines() const { return text() + lines_end_; }
  void advance_to(const char* position) { begin_ = static_cast<std::size_t>(position - text()); }
  /// Reads until a whole line is in the buffer; false at the end of the file. Invalidates pointers into the
  /// buffer. Throws Error(input) for a line longer than kLongestLine.
  bool fill() {
    while (begin_ == lines_end_) {
      if (at_end_) return false;
      if (begin_ > 0) {
        keep_before();
        std::memmove(text(), text() + begin_, end_ - begin_);
        end_ -= begin_;
        begin_ = lines_end_ = 0;
      }
      if (end_ > kLongestLine)
        throw Error(ErrorCode::input, bytes_.path(),
                    "has a line of more than 16 MiB; write one sample on each line");
      const std::size_t needed = end_ + kBlock + 1 + 2 * kNumberMargin;
      if (bytes_read_.size() < needed) bytes_read_.resize(needed);
      const std::size_t got = bytes_.read(text() + end_, kBlock);
      if (got == 0) {
        at_end_ = true;
        last_line_was_open_ = end_ > 0;
        if (end_ > 0) text()[end_++] = '\n';
        lines_end_ = end_;
        continue;
      }
      const void* newline = ::memrchr(text() + end_, '\n', got);
      end_ += got;
      if (newline) lines_end_ = static_cast<std::size_t>(static_cast<const char*>(newline) - text()) + 1;
    }
    return true;
  }

  /// True when the last of the present lines is the last of the file and had no newline.
  bool last_line_was_open() const { return last_line_was_open_; }
  /// Whole lines just before that one, at most a few KiB.
  std::string_view lines_before() const { return before_; }
  void clear() {
    before_.clear();
    begin_ = lines_end_ = end_ = 0;
    at_end_ = last_line_was_open_ = false;
  }

 private:
  const char* text() const { return bytes_read_.data() + kNumberMargin; }
  char* text() { return bytes_read_.data() + kNumberMargin; }
  void keep_before() {
    const std::size_t from = begin_ > kKeptBefore ? begin_ - kKeptBefore : 0;
    before_.assign(text() + from, begin_ - from);
    if (from > 0) before_.erase(0, before_.find('\n') + 1);  // its first line is not whole
  }

  ByteSource& bytes_;
  std::vector<char> bytes_read_;  ///< with kNumberMargin bytes around them
  std::string before_;            ///< the last lines that fill() removed
  std::size_t begin_ = 0;
  std::size_t lines_end_ = 0;
  std::size_t end_ = 0;
  bool at_end_ = false;
  bool last_line_was_open_ = false;
};

std::size_t longest_line(std::string_view text) {
  std::size_t longest = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    longest = std::max(longest, end - begin);
    begin = end + 1;
  }
  return longest;
}

/// Returns a head of the file with room for some of its longest lines, so that a long header, which may take
/// several lines, is whole and has rows below.
std::string_view whole_lines_head(ByteSource& bytes) {
  constexpr std::size_t kLines = 4, kScopeLines = 32;
  const std::size_t lines = begins_like_scope_export(bytes.head()) ? kScopeLines : kLines;
  std::size_t longest = longest_line(bytes.head());
  while (longest <= kLongestHeadLine && bytes.head().size() < lines * longest && bytes.extend_head())
    longest = longest_line(bytes.head());
  if (longest > kLongestHeadLine)
    throw Error(ErrorCode::input, bytes.path(),
                "has a line of more than 1 MiB near its beginning, where the names of the columns are "
                "expected; write the names on one line, then one sample on each line");
  return bytes.head();
}

class CsvReader : public RawReader {
 public:
  CsvReader(std::unique_ptr<ByteSource> bytes, CsvDialect dialect);

  const std::vector<RawColumn>& columns() const override { return dialect_.columns; }
  void want(const std::vector<bool>& columns) override { rows_.want(columns); }
  void code_texts(int column) override { rows_.code_texts(column); }
  bool next(RawBlock& block, int max_rows) override {
    max_rows = std::min(max_rows, std::max(1, kBlockValues / std::max(1, dialect_.fields)));
    rows_.begin_block(block, max_rows);
    block.first_row = at_.row;
    int row = 0;
    while (row < max_rows && lines_.fill()) {
      const char* p = lines_.position();
      const char* const end = lines_.end_of_lines();
      const CsvPlace before = at_;
      const std::int64_t absent_before = rows_.absent_fields();
      bool stop = false;
      while (row < max_rows && p < end && !stop) {
        if (const int rows = read_many(p, end, row, max_rows)) {
          row += rows;
          continue;
        }
        CsvRow verdict = CsvRow::keep;
        p = read_line(p, end, row, verdict);
        ++at_.line;
        at_.row += verdict != CsvRow::skip;
        row += verdict == CsvRow::keep;
        if (verdict == CsvRow::drop) {
          if (row == 0) block.first_row = at_.row;
          stop = row > 0;  // rows of a block are consecutive
        }
      }
      lines_.advance_to(p);
      spend(before, absent_before);
      if (stop) break;
    }
    refuse_mostly_absent();
    if (row == 0) issues_.merge(bytes_->issues());
    identity_.rows_read = at_.row;
    identity_.sha256 = bytes_->sha256();
    block.rows = row;
    for (auto& column : block.columns)
      if (!column.empty()) column.resize(row);
    if (dialect_.filetime)
      for (double& time : block.columns[static_cast<std::size_t>(dialect_.time_column)])
        time = seconds_of_filetime(time);
    return row > 0;
  }

  void rewind() override {
    bytes_->rewind();
    lines_.clear();
    issues_.start();
    rows_.start();
    identity_.rows_read = 0;
    start();
  }

  const Issues& issues() const override { return issues_.all(); }
  bool sparse() const override { return dialect_.sparse; }
  double share_read() const override { return bytes_->share_read(); }

 private:
  void refuse_many_columns() const {
    if (dialect_.fields > kMostFields)
      throw Error(
          ErrorCode::input, bytes_->path(),
          fmt::format("has more than {} columns, the most that a log may have; write one sample on each "
                      "line, with only the columns of the joints",
                      kMostFields));
  }

  void refuse_duplicates() const {
    std::map<std::string, int> seen;
    for (std::size_t i = 0; i < dialect_.columns.size(); ++i) {
      const int field = dialect_.value_fields[i] + 1;
      const auto [before, fresh] = seen.emplace(dialect_.columns[i].name, field);
      if (!fresh)
        throw Error(ErrorCode::input, bytes_->path(),
                    fmt::format("has two columns named \"{}\", columns {} and {}; give each its own name",
                                shortened(before->first, kLongestName), before->second, field));
    }
  }

  /// Rejects files whose rows lack most fields, as they expand to much more data than the file holds.
  void refuse_mostly_absent() const {
    const double all = static_cast<double>(at_.row) * dialect_.fields;
    if (rows_.absent_fields() < kMostAbsent ||
        static_cast<double>(rows_.absent_fields()) < kMostAbsentShare * all)
      return;
    throw Error(
        ErrorCode::input, bytes_->path(),
        fmt::format("has rows that lack most of the {} columns of its header; write all fields of each row",
                    dialect_.fields));
  }

  /// Counts the work on the lines since `before`.
  void spend(const CsvPlace& before, std::int64_t absent_before) {
    const std::int64_t rows = at_.row - before.row, absent = rows_.absent_fields() - absent_before;
    bytes_->spend(kLineWork_ns * (at_.line - before.line) + table_work_ns(rows, dialect_.fields) -
                  kValueWork_ns * absent);
  }

  /// Reads rows of numbers from `p` on together; returns their number, 0 if read_line() must read the next
  /// line.
  int read_many(const char*& p, const char* end, int row, int max_rows) {
    if (lines_.last_line_was_open()) return 0;
    const int rows = rows_.read_many(p, end, row, max_rows);
    at_.line += rows;
    at_.row += rows;
    return rows;
  }

  /// Reads the line at `p` and returns the position after it.
  const char* read_line(const char* p, const char* end, int row, CsvRow& verdict) {
    verdict = CsvRow::keep;
    const bool open = lines_.last_line_was_open();  // then it is the only line in the buffer
    if (const char* after = open ? nullptr : rows_.read_plain(p, end, row)) return after;
    const char* newline = static_cast<const char*>(std::memchr(p, '\n', static_cast<std::size_t>(end - p)));
    const std::string_view line(p, static_cast<std::size_t>(newline - p));
    verdict = open ? rows_.read_open(line, lines_.lines_before(), at_, row) : rows_.read_any(line, at_, row);
    return newline + 1;
  }

  /// Skips the header.
  void start() {
    at_ = {0, dialect_.lines_before};
    std::size_t to_skip = dialect_.data_begin;
    while (to_skip > 0 && lines_.fill()) {
      const std::size_t there = static_cast<std::size_t>(lines_.end_of_lines() - lines_.position());
      const std::size_t now = std::min(to_skip, there);
      lines_.advance_to(lines_.position() + now);
      to_skip -= now;
    }
  }

  std::unique_ptr<ByteSource> bytes_;
  CsvDialect dialect_;
  LineBuffer lines_;
  CsvPlace at_;
  CsvIssues issues_;
  CsvRowReader rows_;
};

CsvReader::CsvReader(std::unique_ptr<ByteSource> bytes, CsvDialect dialect)
    : bytes_(std::move(bytes)),
      dialect_(std::move(dialect)),
      lines_(*bytes_),
      issues_(dialect_),
      rows_(dialect_, issues_) {
  identity_.path = bytes_->path();
  identity_.format = "csv";
  refuse_many_columns();
  refuse_duplicates();
  start();
}

}  // namespace

bool looks_like_csv(std::string_view head) {
  const bool utf16 = head.substr(0, 2) == "\xFF\xFE" || head.substr(0, 2) == "\xFE\xFF";
  return !utf16 && head.find('\0') == std::string_view::npos;
}

std::unique_ptr<RawReader> open_csv(std::unique_ptr<ByteSource> bytes) {
  CsvDialect dialect = find_dialect(whole_lines_head(*bytes));
  if (dialect.others.empty()) return std::make_unique<CsvReader>(std::move(bytes), std::move(dialect));
  const std::string path = bytes->path();
  if (dialect.others.size() > kMostOwnTimes)
    throw Error(ErrorCode::input, path,
                fmt::format("is an export of TwinCAT Scope whose channels have more than {} different times; "
                            "record the joints with one sample time, or export fewer channels",
                            kMostOwnTimes + 1));
  const std::vector<OwnTimeColumns> groups = std::exchange(dialect.others, {});
  auto first = std::make_unique<CsvReader>(std::move(bytes), dialect);
  std::vector<std::unique_ptr<RawReader>> others;
  dialect.issues = {};
  dialect.preamble_lines = 0;
  for (const OwnTimeColumns& group : groups) {
    dialect.columns = group.columns;
    dialect.value_fields = group.value_fields;
    others.push_back(
        rows_of_own_time(std::make_unique<CsvReader>(std::make_unique<ByteSource>(path, false), dialect)));
  }
  return join_files(std::move(first), std::move(others), JoinBy::time);
}

}  // namespace faultline
