// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

namespace faultline {

/// A cell of a text table.
enum class CellKind { number, missing, text };
struct Cell {
  CellKind kind = CellKind::missing;
  double value = 0.0;  ///< NaN unless a number
};

/// Reads one cell: blanks and quotes around it are ignored; empty, "nan", "null", "NA", "-" are missing;
/// "true" and "false" are 1 and 0. A date or a time of day is a number of seconds, see read_clock().
Cell read_cell(std::string_view text, char decimal, bool day_first = false);

/// Upper limit of the columns; a text with more is rejected, so that a small file cannot take much memory.
inline constexpr int kMostFields = 1 << 14;

/// Splits a line at its separators into `fields`, without quotes and blanks around each. A separator between
/// double quotes does not split. The separator ' ' means any run of blanks. The rest after kMostFields fields
/// is one more field, not split.
void split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields);

std::string_view without_blanks(std::string_view text);
bool is_comment_or_blank(std::string_view line);

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
