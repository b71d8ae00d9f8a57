// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

namespace faultline {

/// A line at the beginning of a text file, cut into fields once a separator was chosen.
struct CsvLine {
  std::size_t begin = 0, end = 0;  ///< bytes, end after the newline
  std::string_view text;
  bool comment = false;  ///< or blank
  std::vector<std::string_view> fields{};
  int numbers = 0, texts = 0;  ///< of the fields
};

/// The first lines of a file, without one that `head` cuts.
std::vector<CsvLine> lines_of(std::string_view head);

/// Cuts a line into fields and counts which of them are numbers and texts.
void count_cells(CsvLine& line, char separator, char decimal);

/// The most frequent number of fields; the larger one when two are equally frequent.
int usual_fields(const std::vector<CsvLine>& lines);

/// Whether the line is a row of a table with so many fields.
bool is_data(const CsvLine& line, int fields);

}  // namespace faultline
