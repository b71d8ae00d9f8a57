// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/arrays/array_notes.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// An array of a log that is being written: rows x width, row by row; a vector when `vector`.
struct WrittenArray {
  std::string name;
  std::string unit;  ///< empty for joint channels, which are SI
  int width = 1;
  bool vector = true;
  std::vector<double> values;
};

/// A log as arrays: t, one a quantity (q, dq, tau ..) with a column a joint, and one a further channel, named
/// by `prefix` and a part of its name that any program takes.
class WrittenArrays {
 public:
  /// `path` for messages.
  WrittenArrays(std::string path, std::string prefix);

  /// Appends rows [begin, end) of a segment, whose channels are those of the first. Throws Error(internal)
  /// when they are not.
  void add(const Log& segment, int begin, int end);
  std::int64_t rows() const { return rows_; }
  const std::vector<WrittenArray>& arrays() const { return arrays_; }
  /// Forgets the rows, not the arrays.
  void clear();
  void note_provenance(const std::string& provenance) { notes_.provenance = provenance; }
  /// What is to be stored beside the arrays; empty when they tell all.
  std::string notes() const;

 private:
  void name_arrays(const Log& segment);
  std::string name_of_extra(const std::string& channel) const;

  std::string path_, prefix_;
  std::vector<WrittenArray> arrays_;
  ArrayNotes notes_;
  std::int64_t rows_ = 0;
};

/// Throws Error(output) when bytes can only be sent there, as into a pipe, but `format` must be put together
/// in a file.
void refuse_pipe_for(const std::string& path, const std::string& format);

}  // namespace faultline
