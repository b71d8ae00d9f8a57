// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "formats/byte_window.hpp"
#include "formats/native/native_layout.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// Returns the position in `bytes` of the first undamaged header of a chunk or of provenance, or of the end
/// mark, whose first row is not before `least_row`; npos for none.
std::size_t find_native_header(std::string_view bytes, std::uint64_t least_row);

/// The undamaged chunks of a native log in their order. Damaged parts are omitted and reported as issues: the
/// chunks continue at the next header that can be found.
class NativeChunks {
 public:
  NativeChunks(ByteWindow& bytes, std::size_t channels, Issues& issues)
      : bytes_(bytes), channels_(channels), issues_(issues) {}

  /// Moves to the next chunk; false after the last one, when the file has been read to its end.
  bool next();
  std::int64_t first_row() const { return static_cast<std::int64_t>(next_row_) - rows_; }
  std::int64_t rows() const { return rows_; }
  /// Copies `count` values of a channel from row `row` of the chunk on.
  void copy(std::size_t channel, std::int64_t row, std::int64_t count, double* to) const;
  std::int64_t rows_lost() const { return rows_lost_; }

 private:
  bool find_header(NativeChunkHeader& header);
  bool take(const NativeChunkHeader& header);
  void read_provenance(const NativeChunkHeader& header);
  bool may_search() const;
  void pass_damaged(const NativeChunkHeader& header, std::size_t size, bool whole);
  void lose(const char* code, std::uint64_t rows, const std::string& what);
  void finish();

  ByteWindow& bytes_;
  std::size_t channels_;
  Issues& issues_;
  std::uint64_t next_row_ = 0;     ///< all rows before it were handed out or lost
  std::int64_t rows_ = 0;          ///< in the present chunk
  std::size_t chunk_bytes_ = 0;    ///< of the present chunk, at the front of the view
  std::int64_t bytes_hashed_ = 0;  ///< of damaged chunks and provenance
  std::int64_t rows_lost_ = 0;
  bool finished_ = false;
};

}  // namespace faultline
