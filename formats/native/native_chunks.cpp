// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "formats/native/native_layout.hpp"
#include "formats/provenance.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

constexpr std::size_t kHeaderBytes = sizeof(NativeChunkHeader);
/// Damaged blocks are searched for the next header while the bytes hashed in damaged blocks are no more than
/// this plus the file up to there; else nested ones would take time with the square of their number.
constexpr std::int64_t kSearchedFreely = 1 << 24;

NativeChunkHeader header_at(std::string_view bytes, std::size_t at) {
  NativeChunkHeader header;
  std::memcpy(&header, bytes.data() + at, sizeof header);
  return header;
}

}  // namespace

std::size_t find_native_header(std::string_view bytes, std::uint64_t least_row) {
  for (std::size_t at = 0; at + kHeaderBytes <= bytes.size(); ++at) {
    std::uint32_t marker = 0;
    std::memcpy(&marker, bytes.data() + at, sizeof marker);
    if (!is_known_marker(marker)) continue;
    const NativeChunkHeader header = header_at(bytes, at);
    if (header.first_row >= least_row && is_sound(header)) return at;
  }
  return std::string_view::npos;
}

void NativeChunks::copy(std::size_t channel, std::int64_t row, std::int64_t count, double* to) const {
  const char* from =
      bytes_.view().data() + (channel * static_cast<std::size_t>(rows_) + row) * sizeof(double);
  std::memcpy(to, from, count * sizeof(double));
}

void NativeChunks::lose(const char* code, std::uint64_t rows, const std::string& what) {
  const auto lost = static_cast<std::int64_t>(rows), before = static_cast<std::int64_t>(next_row_);
  issues_.add(
      {code, "", Severity::severe, fmt::format("after row {}: {}", before, what), before + 1, kNan, 1, lost});
  next_row_ += rows;
  rows_lost_ += lost;
}

/// Finds the next undamaged header, if necessary after damaged bytes.
bool NativeChunks::find_header(NativeChunkHeader& header) {
  std::size_t skipped = 0;
  while (bytes_.fill(kHeaderBytes)) {
    const std::string_view view = bytes_.view();
    const std::size_t found = find_native_header(view, next_row_);
    const std::size_t passed = found == std::string_view::npos ? view.size() - (kHeaderBytes - 1) : found;
    skipped += passed;
    if (found != std::string_view::npos) header = header_at(view, found);
    bytes_.advance(passed);
    if (found == std::string_view::npos) continue;
    bytes_.advance(kHeaderBytes);
    const std::uint64_t missing = header.first_row - next_row_;
    const std::string where =
        skipped > 0 ? fmt::format("{} bytes are damaged", skipped) : "chunks are missing";
    if (skipped > 0 || missing > 0)
      lose("chunk_damaged", missing, fmt::format("{}; {} rows were left out", where, missing));
    return true;
  }
  lose("file_truncated", 0,
       fmt::format("the file ends without its end mark; {} bytes after the last complete chunk were left out",
                   skipped + bytes_.view().size()));
  bytes_.advance(bytes_.view().size());
  return false;
}

bool NativeChunks::next() {
  bytes_.advance(chunk_bytes_);
  chunk_bytes_ = 0;
  rows_ = 0;
  while (!finished_) {
    NativeChunkHeader header;
    if (!find_header(header) || header.marker == kEndMarker) {
      finish();
      return false;
    }
    if (header.marker == kProvenanceMarker)
      read_provenance(header);
    else if (take(header))
      return true;
  }
  return false;
}

bool NativeChunks::may_search() const { return bytes_hashed_ <= kSearchedFreely + bytes_.position(); }

bool NativeChunks::take(const NativeChunkHeader& header) {
  const std::size_t size = header.rows * channels_ * sizeof(double);
  const bool whole = bytes_.fill(size);
  if (!whole || native_hash(bytes_.view().substr(0, size)) != header.data_hash) {
    pass_damaged(header, size, whole);
    return false;
  }
  rows_ = header.rows;
  next_row_ += header.rows;
  chunk_bytes_ = size;
  return true;
}

/// Skips a damaged chunk. If bytes are missing, the next header is within the assumed numbers.
void NativeChunks::pass_damaged(const NativeChunkHeader& header, std::size_t size, bool whole) {
  bytes_.fill(size + kHeaderBytes - 1);
  const std::string_view view = bytes_.view();
  const std::size_t reach = std::min(view.size(), size + kHeaderBytes - 1);
  bytes_hashed_ += whole ? static_cast<std::int64_t>(size) : 0;
  const std::size_t found = may_search() ? find_native_header(view.substr(0, reach), next_row_ + header.rows)
                                         : std::string_view::npos;
  if (whole)
    lose("chunk_damaged", header.rows,
         fmt::format("the checksum of a chunk does not match; its {} rows were left out", header.rows));
  else if (found != std::string_view::npos)
    lose("chunk_damaged", header.rows,
         fmt::format("a chunk is incomplete; its {} rows were left out", header.rows));
  else
    lose("file_truncated", header.rows,
         fmt::format("the file is cut inside a chunk; its {} rows were left out", header.rows));
  bytes_.advance(std::min(found, whole ? size : view.size()));
  if (!whole && found == std::string_view::npos) finish();
}

/// Reads the provenance. If its text is damaged, the search for the next header begins at its first byte.
void NativeChunks::read_provenance(const NativeChunkHeader& header) {
  const std::size_t size = header.rows;
  const bool whole = bytes_.fill(size);
  const std::string_view text = bytes_.view().substr(0, size);
  const bool sound = whole && native_hash(text) == header.data_hash;
  issues_.add(issue_from_provenance(sound ? text : ""));
  if (whole && !sound) bytes_hashed_ += static_cast<std::int64_t>(size);
  if (sound || (whole && !may_search())) bytes_.advance(size);
}

/// Reads the rest of the file, so that the hash covers all of it.
void NativeChunks::finish() {
  finished_ = true;
  const std::int64_t more = bytes_.drain();
  if (more > 0)
    issues_.add({"trailing_bytes", "", Severity::warning,
                 fmt::format("{} bytes after the end mark were ignored", more)});
}

}  // namespace faultline
