// SPDX-License-Identifier: MIT
#include "formats/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "formats/csv_dialect.hpp"
#include "formats/csv_issues.hpp"
#include "formats/csv_row.hpp"
#include "formats/line_buffer.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

class CsvReader : public RawReader {
 public:
  explicit CsvReader(std::unique_ptr<ByteSource> bytes);

  const std::vector<RawColumn>& columns() const override { return dialect_.columns; }
  void want(const std::vector<bool>& columns) override { rows_.want(columns); }
  bool next(RawBlock& block, int max_rows) override;
  void rewind() override;
  const LogIdentity& identity() const override { return identity_; }
  const Issues& issues() const override { return issues_.all(); }
  double share_read() const override { return bytes_->share_read(); }

 private:
  void refuse_duplicates() const;
  void start();

  std::unique_ptr<ByteSource> bytes_;
  CsvDialect dialect_;
  LineBuffer lines_;
  CsvPlace at_;
  CsvIssues issues_;
  CsvRowReader rows_;
  LogIdentity identity_;
};

CsvReader::CsvReader(std::unique_ptr<ByteSource> bytes)
    : bytes_(std::move(bytes)),
      dialect_(find_dialect(bytes_->head())),
      lines_(*bytes_),
      issues_(dialect_),
      rows_(dialect_, issues_) {
  identity_.path = bytes_->path();
  identity_.format = "csv";
  refuse_duplicates();
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
                              shortened(before->first, kLongestName), before->second, field));
  }
}

/// Reads past the header.
void CsvReader::start() {
  at_ = {0, dialect_.lines_before};
  std::size_t to_skip = dialect_.data_begin;
  while (to_skip > 0 && lines_.fill()) {
    const std::size_t there = static_cast<std::size_t>(lines_.end_of_lines() - lines_.position());
    const std::size_t now = std::min(to_skip, there);
    lines_.advance_to(lines_.position() + now);
    to_skip -= now;
  }
}

void CsvReader::rewind() {
  bytes_->rewind();
  lines_.clear();
  issues_.start();
  identity_.rows_read = 0;
  start();
}

bool CsvReader::next(RawBlock& block, int max_rows) {
  rows_.begin_block(block, max_rows);
  block.first_row = at_.row;
  int row = 0;
  while (row < max_rows && lines_.fill()) {
    const char* p = lines_.position();
    const char* const end = lines_.end_of_lines();
    bool stop = false;
    while (row < max_rows && p < end && !stop) {
      const char* after = rows_.read_plain(p, end, row);
      CsvRow verdict = CsvRow::keep;
      if (!after) {
        const char* newline =
            static_cast<const char*>(std::memchr(p, '\n', static_cast<std::size_t>(end - p)));
        after = newline + 1;
        verdict = rows_.read_any({p, static_cast<std::size_t>(newline - p)},
                                 lines_.last_line_was_open() && after == end, at_, row);
      }
      p = after;
      ++at_.line;
      at_.row += verdict != CsvRow::skip;
      row += verdict == CsvRow::keep;
      if (verdict == CsvRow::drop) {
        if (row == 0) block.first_row = at_.row;
        stop = row > 0;  // rows of a block follow each other
      }
    }
    lines_.advance_to(p);
    if (stop) break;
  }
  issues_.flush_text_counts();
  identity_.rows_read = at_.row;
  identity_.sha256 = bytes_->sha256();
  block.rows = row;
  for (auto& column : block.columns)
    if (!column.empty()) column.resize(row);
  return row > 0;
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
