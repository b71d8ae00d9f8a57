// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/csv/csv_dialect.hpp"
#include "formats/csv/wide_rows.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Position in a text table that is being read.
struct CsvPlace {
  std::int64_t row = 0;   ///< data rows before the present one
  std::int64_t line = 0;  ///< lines before the present one
};

/// Collects the issues of the rows of a text table; messages name row, line and column.
class CsvIssues {
 public:
  /// The dialect must outlive the object.
  explicit CsvIssues(const CsvDialect& dialect) : dialect_(dialect) { start(); }

  /// Restarts, with the issues of the lines above the table only.
  void start();
  /// Adds a cell of the dialect's column `column` (its field is `field`, from 0) that is neither number nor
  /// missing.
  void add_text(const CsvPlace& place, int column, int field, std::string_view cell);
  /// Adds a row; `what()` describes its defect and is called only for the first row of a code.
  template <typename What>
  void add_row(const CsvPlace& place, const char* code, What what, bool dropped,
               Severity severity = Severity::warning) {
    if (count_row(code, dropped)) return;
    add_first_row(place, code, what(), dropped, severity);
  }
  /// Adds issues of the file as a whole.
  void merge(const Issues& issues) { issues_.merge(issues); }
  void add(const Issue& issue) { issues_.add(issue); }
  const Issues& all() const;

 private:
  /// Further rows of a code that issues_ contains, not yet counted there.
  struct MoreRows {
    std::string code;
    std::int64_t count = 0, dropped = 0;
  };

  /// Counts one more row and returns true if the code is in more_rows_.
  bool count_row(std::string_view code, bool dropped);
  void add_first_row(const CsvPlace& place, const char* code, const std::string& what, bool dropped,
                     Severity severity);

  const CsvDialect& dialect_;
  std::vector<bool> has_text_;  ///< of each column, whether issues_ has an issue about its texts
  // Counted separately while rows are read, so that no search through issues_ is needed for each defect.
  mutable Issues issues_;
  mutable std::vector<std::int64_t> text_cells_;  ///< of each column, not yet in issues_
  mutable std::vector<MoreRows> more_rows_;
};

/// Result of reading a line that is no plain row of numbers: a row, no row, or a row that is omitted.
enum class CsvRow { keep, skip, drop };

/// Reads lines of a text table into the rows of a block.
class CsvRowReader {
 public:
  /// Both must outlive the object.
  CsvRowReader(const CsvDialect& dialect, CsvIssues& issues);

  /// Selects columns, as RawReader::want() does.
  void want(const std::vector<bool>& columns);
  /// Makes the texts of a column numbers, as RawReader::code_texts() does.
  void code_texts(int column) { coded_column_ = column; }
  /// Sets the block for the following rows, with room for `max_rows`.
  void begin_block(RawBlock& block, int max_rows);
  /// Reads as many lines of only numbers and separators as it quickly can into the rows from `row` on and
  /// moves `p` behind them; returns their number. kNumberMargin bytes around the text must be readable.
  int read_many(const char*& p, const char* end, int row, int max_rows);
  /// Reads a line of only numbers and separators into row `row` of the block and returns the position after
  /// it; null for any other line, which read_any() must read. `end` is after a newline.
  const char* read_plain(const char* p, const char* end, int row);
  /// Reads any line, without its newline. `usual` is the format of last cells if the file ended in this line;
  /// else null.
  CsvRow read_any(std::string_view line, const CsvPlace& at, int row, const LastCells* usual = nullptr);
  /// Reads a last line that has no newline; `before` are whole lines before it.
  CsvRow read_open(std::string_view line, std::string_view before, const CsvPlace& at, int row);
  /// Number of fields that rows lacked at their ends so far.
  std::int64_t absent_fields() const { return absent_fields_; }
  /// Restarts at the first row.
  void start();

 private:
  void place_columns(const std::vector<int>& fields);
  void find_places();
  bool take_header(const CsvPlace& at);
  CsvRow judge_length(std::string_view line, const CsvPlace& at);
  CsvRow judge_end(std::string_view line, const CsvPlace& at, const LastCells& usual);
  std::string field_count(std::string_view line) const;
  void read_cells(const CsvPlace& at, int row);
  void add_date(int row);

  const CsvDialect& dialect_;
  CsvIssues& issues_;
  std::vector<bool> wanted_;           ///< of each column
  std::vector<int> value_fields_;      ///< field of each column, by the latest header
  int coded_column_ = -1;              ///< whose texts become numbers; -1 for none
  bool is_other_table_ = false;        ///< the latest header has other columns than the first one
  RawBlock* block_ = nullptr;          ///< block that is being filled
  std::vector<int> column_of_field_;   ///< -1 for a field that is not wanted
  std::vector<double*> field_values_;  ///< in block_; null for a field that is not wanted
  std::vector<std::string_view> fields_;
  WideRows wide_;
  std::int64_t absent_fields_ = 0;
};

}  // namespace faultline
