// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "lib/core/issue.hpp"

namespace faultline {

/// An array of numbers in a file. Shapes are those that the file's own program shows.
struct NamedArray {
  std::string name;                 ///< parts of a path between '/' or '.'; empty when the file gives none
  std::vector<std::int64_t> shape;  ///< empty for a single number
  std::string unit{};
  std::vector<std::string> names{}, units{};  ///< of its columns, where the file tells them
  bool exact = false;                         ///< `names` and `units` are to be taken as they are
  int rank = 0;                               ///< columns of arrays of a lower rank come first
  bool unwritten = false;                     ///< the file has room for it, but no value of it was written
  bool records = false;  ///< its first dimension counts records: it cannot be channel major
  /// Rows, and columns, from the first one on, that the file can hold at most, whatever the shape says, once
  /// it is read by rows or by columns.
  std::function<std::int64_t(bool channel_major)> rows_held{}, columns_held{};
};

/// Consecutive rows of some columns of an array, which counts as rows x columns (or, channel major, columns x
/// rows).
struct ArrayBand {
  std::size_t array = 0;
  bool channel_major = false;
  std::int64_t first_row = 0, rows = 0;
  std::vector<std::int64_t> columns{};
};

/// Rows of a band that could not be read; they follow its first one by `first`.
struct LostRows {
  std::int64_t first = 0, rows = 0;
  int column = -1;  ///< index in ArrayBand::columns; -1 for all of them
};

/// What a band was read into.
struct BandValues {
  std::vector<std::vector<double>> columns;  ///< in the order of ArrayBand::columns, of rows enough
  std::vector<LostRows> lost;                ///< no row of a column twice
};

/// A file that is open for reading its arrays.
class ArrayFile {
 public:
  virtual ~ArrayFile() = default;
  virtual const std::vector<NamedArray>& arrays() const = 0;
  /// Arrays and parts that were passed over when it was opened, and what was found wrong while reading; told
  /// in full only after the last row.
  virtual const Issues& issues() const = 0;
  /// The text of notes_text() when a log was written to the file, else empty.
  virtual std::string notes() const = 0;
  /// Which arrays read() will be asked for, before it is. Throws Error(input) when they cannot be read in
  /// bounded memory.
  virtual void will_read(const std::vector<ArrayBand>&) {}
  /// Bands of an array come in the order of their rows.
  virtual void read(const ArrayBand& band, BandValues& values) = 0;
  /// What is to be checked when all has been read.
  virtual void finish() {}
};

/// Opens the file at the path. Throws Error(input) when it cannot be read at all.
using OpenArrays = std::unique_ptr<ArrayFile> (*)(const std::string& path);

}  // namespace faultline
