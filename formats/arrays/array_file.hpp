// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/byte_source.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Name of the text that is stored beside the arrays of a written log.
inline constexpr const char* kNotesName = "faultline";

/// An extra channel of a written log with its original name and unit.
struct NotedChannel {
  std::string array;  ///< its name in the file
  std::string name;
  std::string unit;
};

/// The content of a log that arrays alone cannot store.
struct ArrayNotes {
  std::vector<NotedChannel> extra;
  std::string provenance;  ///< as passed to LogWriter::note_provenance()
};

/// Returns one line of JSON, schema "faultline/arrays/1", in ASCII.
std::string notes_text(const ArrayNotes& notes);
/// Parses notes_text(); nullopt when the text is not valid.
std::optional<ArrayNotes> read_notes(std::string_view text);

/// An array of numbers in a file. The shape is the one that the program that wrote the file shows.
struct NamedArray {
  std::string name;                 ///< parts of a path between '/' or '.'; empty when the file gives none
  std::vector<std::int64_t> shape;  ///< empty for a single number
  std::string unit{};
  std::vector<std::string> names{}, units{};  ///< of its columns, if the file gives them
  bool exact = false;                         ///< `names` and `units` are used unchanged
  int rank = 0;                               ///< sorts columns: arrays of a lower rank come first
  bool unwritten = false;                     ///< the file has room for it, but no value was written
  bool records = false;  ///< the first dimension counts records: it cannot be channel major
  /// Upper limit of the rows, and columns, counted from the first, that the file can hold when the array is
  /// read by rows or by columns, independent of its shape.
  std::function<std::int64_t(bool channel_major)> rows_held{}, columns_held{};
};

/// Consecutive rows of some columns of an array of rows x columns (or, channel major, columns x rows).
struct ArrayBand {
  std::size_t array = 0;
  bool channel_major = false;
  std::int64_t first_row = 0, rows = 0;
  std::vector<std::int64_t> columns{};
};

/// Rows of a band that could not be read; `first` counts from the first row of the band.
struct LostRows {
  std::int64_t first = 0, rows = 0;
  int column = -1;  ///< index in ArrayBand::columns; -1 for all of them
};

/// The values of a band.
struct BandValues {
  std::vector<std::vector<double>> columns;  ///< in the order of ArrayBand::columns; band.rows or longer
  std::vector<LostRows> lost;                ///< no row of a column twice
};

/// A file that is open for reading its arrays.
class ArrayFile {
 public:
  virtual ~ArrayFile() = default;
  const std::vector<NamedArray>& arrays() const { return arrays_; }
  /// Arrays and parts that were skipped when the file was opened, and damage found while reading; complete
  /// only after the last row.
  const Issues& issues() const { return issues_; }
  /// The text of notes_text() if a log was written to the file, else empty.
  const std::string& notes() const { return notes_; }
  /// Announces the arrays that read() will be called for. Throws Error(input) when they cannot be read in
  /// bounded memory.
  virtual void will_read(const std::vector<ArrayBand>&) {}
  /// Reads a band into `values`. Calls for one array must be in the order of its rows.
  virtual void read(const ArrayBand& band, BandValues& values) = 0;
  /// Makes the checks that need the whole file, such as checksums.
  virtual void finish() {}

 protected:
  std::vector<NamedArray> arrays_;
  Issues issues_;
  std::string notes_;
};

/// Opens the file at the path. Throws Error(input) when it cannot be read at all.
using OpenArrays = std::unique_ptr<ArrayFile> (*)(const std::string& path);

/// Opens the arrays of a file as the columns of a log. A value that cannot be read is NaN; a row without its
/// time, or without any value, is omitted. Both are reported as issues. The file is open only while rows are
/// read. Throws Error(input) when it holds no array, cannot be read at all, or is a pipe.
std::unique_ptr<RawReader> read_arrays(std::unique_ptr<ByteSource> bytes, const std::string& format,
                                       OpenArrays open);

/// Converts the path of a dataset to the name that MATLAB shows; MATLAB stores matrices transposed.
using MatlabNaming = std::string (*)(const std::string& path);

/// Opens the datasets of an HDF5 file; `matlab` is null for an ordinary file.
std::unique_ptr<ArrayFile> open_hdf5_arrays(const std::string& path, MatlabNaming matlab);

}  // namespace faultline
