// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/csv/csv_dialect.hpp"
#include "lib/core/issue.hpp"

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
  /// Adds the issues of the bytes of the file.
  void add_bytes(const Issues& issues) { issues_.merge(issues); }
  /// Adds the issue of the damaged log that this one was converted from.
  void add_provenance(std::string_view text);
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

}  // namespace faultline
