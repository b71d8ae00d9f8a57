// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/arrays/array_file.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// An array of a log that is being written: rows x width, row by row; a vector if `vector` is set.
struct WrittenArray {
  std::string name;
  std::string unit;  ///< empty for joint channels, which are SI
  int width = 1;
  bool vector = true;
  std::vector<double> values;
};

/// A log as arrays: t, one per quantity (q, dq, tau ..) with a column per joint, and one per extra channel,
/// named by `prefix` and a part of its name that any program accepts.
class WrittenArrays {
 public:
  /// `path` is used in messages.
  WrittenArrays(std::string path, std::string prefix);

  /// Appends rows [begin, end) of a segment, whose channels are those of the first. Throws Error(internal)
  /// for another number of channels.
  void add(const Log& segment, int begin, int end);
  std::int64_t rows() const { return rows_; }
  const std::vector<WrittenArray>& arrays() const { return arrays_; }
  /// Removes the rows, not the arrays.
  void clear();
  void note_provenance(const std::string& provenance) { notes_.provenance = provenance; }
  /// Returns the text to store beside the arrays; empty when they hold everything.
  std::string notes() const;

 private:
  void name_arrays(const Log& segment);
  std::string name_of_extra(const std::string& channel) const;

  std::string path_, prefix_;
  std::vector<WrittenArray> arrays_;
  std::size_t channels_ = 0;  ///< of the log
  ArrayNotes notes_;
  std::int64_t rows_ = 0;
};

}  // namespace faultline
