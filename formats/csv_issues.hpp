// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/csv_dialect.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// Where a text table is being read.
struct CsvPlace {
  std::int64_t row = 0;   ///< data rows before the present one
  std::int64_t line = 0;  ///< lines before the present one
};

/// What was wrong with the rows of a text table; messages name row, line and column.
class CsvIssues {
 public:
  /// The dialect must outlive the object.
  explicit CsvIssues(const CsvDialect& dialect) : dialect_(dialect) { start(); }

  /// Begins again, with what was met above the table.
  void start();
  /// A cell of the dialect's column `column` (its field is `field`, from 0) that is neither number nor
  /// missing.
  void add_text(const CsvPlace& place, int column, int field, std::string_view cell);
  void add_row(const CsvPlace& place, const char* code, const std::string& what, bool dropped);
  /// Cells of text are counted apart while rows are read; puts their counts into all().
  void flush_text_counts();
  const Issues& all() const { return issues_; }

 private:
  const CsvDialect& dialect_;
  Issues issues_;
  std::vector<std::int64_t> text_cells_;  ///< of each column, not yet in issues_ but known to it
};

}  // namespace faultline
