// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

namespace faultline {

/// A line at the beginning of a text file, split into fields once a separator was chosen.
struct CsvLine {
  std::size_t begin = 0, end = 0;  ///< bytes, end after the newline
  std::string_view text;
  bool comment = false;  ///< or blank
  std::vector<std::string_view> fields{};
  int numbers = 0, texts = 0;  ///< of the fields
};

/// Returns the first lines of a file, without one that `head` cuts.
std::vector<CsvLine> lines_of(std::string_view head);

/// Splits a line into fields and counts numbers and texts among them.
void count_cells(CsvLine& line, char separator, char decimal);

/// Returns the most frequent number of fields; the larger of equally frequent ones.
int usual_fields(const std::vector<CsvLine>& lines);

/// True when the line is a row of a table with so many fields.
bool is_data(const CsvLine& line, int fields);

}  // namespace faultline
