// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "formats/byte_source.hpp"
#include "formats/known_formats.hpp"
#include "formats/native/native_layout.hpp"
#include "formats/provenance.hpp"
#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"
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

/// Returns the position in `bytes` of the first undamaged header of a chunk or of provenance, or of the end
/// mark, whose first row is not before `least_row`; npos for none.
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

/// The undamaged chunks of a native log in their order. Damaged parts are omitted and reported as issues: the
/// chunks continue at the next valid header.
class NativeChunks {
 public:
  NativeChunks(ByteWindow& bytes, std::size_t channels, Issues& issues)
      : bytes_(bytes), channels_(channels), issues_(issues) {}

  /// Moves to the next chunk; false after the last one, when the file has been read to its end.
  bool next() {
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
  std::int64_t first_row() const { return static_cast<std::int64_t>(next_row_) - rows_; }
  std::int64_t rows() const { return rows_; }
  /// Copies `count` values of a channel from row `row` of the chunk on.
  void copy(std::size_t channel, std::int64_t row, std::int64_t count, double* to) const {
    const char* from =
        bytes_.view().data() + (channel * static_cast<std::size_t>(rows_) + row) * sizeof(double);
    std::memcpy(to, from, count * sizeof(double));
  }
  std::int64_t rows_lost() const { return rows_lost_; }

 private:
  /// Finds the next undamaged header, if necessary after damaged bytes.
  bool find_header(NativeChunkHeader& header) {
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
         fmt::format(
             "the file ends without its end mark; {} bytes after the last complete chunk were left out",
             skipped + bytes_.view().size()));
    bytes_.advance(bytes_.view().size());
    return false;
  }

  bool take(const NativeChunkHeader& header) {
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

  /// Reads the provenance. If its text is damaged, the search for the next header begins at its first byte.
  void read_provenance(const NativeChunkHeader& header) {
    const std::size_t size = header.rows;
    const bool whole = bytes_.fill(size);
    const std::string_view text = bytes_.view().substr(0, size);
    const bool sound = whole && native_hash(text) == header.data_hash;
    issues_.add(issue_from_provenance(sound ? text : ""));
    if (whole && !sound) bytes_hashed_ += static_cast<std::int64_t>(size);
    if (sound || (whole && !may_search())) bytes_.advance(size);
  }

  bool may_search() const { return bytes_hashed_ <= kSearchedFreely + bytes_.position(); }

  /// Skips a damaged chunk. If bytes are missing, the next header is within the assumed numbers.
  void pass_damaged(const NativeChunkHeader& header, std::size_t size, bool whole) {
    bytes_.fill(size + kHeaderBytes - 1);
    const std::string_view view = bytes_.view();
    const std::size_t reach = std::min(view.size(), size + kHeaderBytes - 1);
    bytes_hashed_ += whole ? static_cast<std::int64_t>(size) : 0;
    const std::size_t found = may_search()
                                  ? find_native_header(view.substr(0, reach), next_row_ + header.rows)
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

  void lose(const char* code, std::uint64_t rows, const std::string& what) {
    const auto lost = static_cast<std::int64_t>(rows), before = static_cast<std::int64_t>(next_row_);
    issues_.add({code, "", Severity::severe, fmt::format("after row {}: {}", before, what), before + 1, kNan,
                 1, lost});
    next_row_ += rows;
    rows_lost_ += lost;
  }

  /// Reads the rest of the file, so that the hash covers all of it.
  void finish() {
    finished_ = true;
    const std::int64_t more = bytes_.drain();
    if (more > 0)
      issues_.add({"trailing_bytes", "", Severity::warning,
                   fmt::format("{} bytes after the end mark were ignored", more)});
  }

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

constexpr int kMostTries = 4;               ///< positions tried for the second copy
constexpr std::size_t kFarthestShift = 64;  ///< largest displacement of the copy by damage, bytes

[[noreturn]] void fail_preface(const std::string& path, const std::string& what) {
  throw Error(ErrorCode::input, path, what);
}

NativePreface first_fields(std::string_view bytes) {
  NativePreface preface;
  std::memcpy(&preface, bytes.data(), sizeof preface);
  return preface;
}

/// Returns the bytes of the preface at position `at` of the view, with its hash; 0 when it is damaged.
std::size_t sound_preface(ByteWindow& bytes, std::size_t at) {
  if (!bytes.fill(at + sizeof(NativePreface))) return 0;
  const NativePreface preface = first_fields(bytes.view().substr(at));
  if (preface.version != kNativeVersion || preface.list_bytes > kLongestList) return 0;
  const std::size_t hashed = sizeof preface + preface.list_bytes, size = hashed + sizeof(std::uint64_t);
  if (!bytes.fill(at + size)) return 0;
  const std::string_view all = bytes.view().substr(at, size);
  std::uint64_t hash = 0;
  std::memcpy(&hash, all.data() + hashed, sizeof hash);
  const bool sound =
      all.substr(0, kNativeMagic.size()) == kNativeMagic && hash == native_hash(all.substr(0, hashed));
  return sound ? size : 0;
}

/// Returns the position of the second copy if the first is damaged; 0 when both are.
std::size_t second_copy(ByteWindow& bytes) {
  bytes.fill(2 * (sizeof(NativePreface) + kLongestList + sizeof(std::uint64_t)));
  std::size_t at = 0;
  for (int i = 0; i < kMostTries; ++i) {
    at = bytes.view().find(kNativeMagic, at + 1);
    if (at == std::string_view::npos) return 0;
    const std::size_t size = sound_preface(bytes, at);
    if (size > 0 && at <= size + kFarthestShift) return at;
  }
  return 0;
}

[[noreturn]] void refuse(ByteWindow& bytes, const std::string& path) {
  if (bytes.view().size() < sizeof(NativePreface))
    fail_preface(path, "is cut inside its header; nothing can be read from it");
  const NativePreface preface = first_fields(bytes.view());
  if (preface.version > kNativeVersion)
    fail_preface(path,
                 fmt::format("has format version {}, this program reads version {}; use a newer faultline",
                             preface.version, kNativeVersion));
  if (preface.version > 0 && preface.version < kNativeVersion)
    fail_preface(path,
                 fmt::format("has format version {} of an earlier program, this one reads version {}; record "
                             "it again, or convert its original again with faultline convert",
                             preface.version, kNativeVersion));
  fail_preface(path, "has a damaged header (its checksum does not match); nothing can be read from it");
}

std::vector<RawColumn> columns_of(std::string_view list, const std::string& path) {
  std::vector<RawColumn> columns;
  const auto count = static_cast<std::size_t>(std::count(list.begin(), list.end(), '\n'));
  if (count > kMostChannels)
    fail_preface(path, fmt::format("declares {} channels, but at most {} can be read", count, kMostChannels));
  for (std::size_t begin = 0; begin < list.size();) {
    const auto tab = list.find('\t', begin), end = list.find('\n', begin);
    if (tab >= end || end == std::string::npos) fail_preface(path, "has a channel list that cannot be read");
    columns.push_back(
        {std::string(list.substr(begin, tab - begin)), std::string(list.substr(tab + 1, end - tab - 1))});
    begin = end + 1;
  }
  if (columns.empty()) fail_preface(path, "has an empty channel list");
  return columns;
}

void note_damaged_copy(Issues& issues) {
  issues.add({"header_damaged", "", Severity::warning,
              "one of the two copies of the header is damaged; the other one was read"});
}

/// Skips the second copy, damaged or not.
void pass_copy(ByteWindow& bytes, const std::string& first, Issues& issues) {
  bytes.fill(first.size() + sizeof(NativeChunkHeader));
  if (bytes.view().substr(0, first.size()) == first) return bytes.advance(first.size());
  note_damaged_copy(issues);
  const auto reach = std::min(bytes.view().size(), first.size() + sizeof(NativeChunkHeader));
  const std::size_t chunk = find_native_header(bytes.view().substr(0, reach), 0);
  if (chunk != std::string_view::npos) bytes.advance(chunk);
}

/// Reads the columns from the preface of a native log, or from its second copy when the first is damaged
/// (which adds an issue), and moves `bytes` to the first chunk. Throws Error(input) when none can be read or
/// the file is of another version.
std::vector<RawColumn> read_native_preface(ByteWindow& bytes, const std::string& path, Issues& issues) {
  std::size_t size = sound_preface(bytes, 0);
  const bool first_is_sound = size > 0;
  if (!first_is_sound) {
    const std::size_t at = second_copy(bytes);
    if (at == 0) refuse(bytes, path);
    note_damaged_copy(issues);
    size = sound_preface(bytes, at);
    bytes.advance(at);
  }
  const std::string preface(bytes.view().substr(0, size));
  bytes.advance(size);
  const std::size_t list = sizeof(NativePreface);
  std::vector<RawColumn> columns =
      columns_of(std::string_view(preface).substr(list, size - list - sizeof(std::uint64_t)), path);
  if (first_is_sound) pass_copy(bytes, preface, issues);
  return columns;
}

class NativeReader : public RawReader {
 public:
  explicit NativeReader(std::unique_ptr<ByteSource> bytes) : bytes_(std::move(bytes)), window_(*bytes_) {
    identity_.path = bytes_->path();
    identity_.format = "native";
    start();
    wanted_.assign(columns_.size(), true);
  }

  const std::vector<RawColumn>& columns() const override { return columns_; }
  const Issues& issues() const override { return issues_; }
  bool canonical() const override { return true; }
  double share_read() const override { return bytes_->share_read(); }

  bool next(RawBlock& block, int max_rows) override {
    block.rows = 0;
    block.columns.resize(columns_.size());
    while (block.rows < max_rows) {
      if (given_ == chunks_->rows() && !next_chunk()) break;
      const std::int64_t row = chunks_->first_row() + given_;
      if (block.rows == 0) block.first_row = row;
      if (row != block.first_row + block.rows) break;  // rows of a block are consecutive
      give(block, std::min<std::int64_t>(max_rows - block.rows, chunks_->rows() - given_));
    }
    for (std::size_t c = 0; c < columns_.size(); ++c)
      if (wanted_[c]) block.columns[c].resize(block.rows);
    rows_given_ += block.rows;
    identity_.rows_read = rows_given_ + chunks_->rows_lost();
    return block.rows > 0;
  }

  void rewind() override {
    bytes_->rewind();
    window_.clear();
    issues_ = {};
    start();
  }

 private:
  void start() {
    columns_ = read_native_preface(window_, bytes_->path(), issues_);
    chunks_.emplace(window_, columns_.size(), issues_);
    given_ = rows_given_ = 0;
    identity_.rows_read = 0;
  }

  bool next_chunk() {
    given_ = 0;
    if (chunks_->next()) return true;
    issues_.merge(bytes_->issues());
    identity_.sha256 = bytes_->sha256();
    return false;
  }

  void give(RawBlock& block, std::int64_t rows) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (!wanted_[c]) continue;
      std::vector<double>& column = block.columns[c];
      if (std::ssize(column) < block.rows + rows) column.resize(block.rows + rows);
      chunks_->copy(c, given_, rows, column.data() + block.rows);
    }
    given_ += rows;
    block.rows += static_cast<int>(rows);
  }

  std::unique_ptr<ByteSource> bytes_;
  ByteWindow window_;
  std::vector<RawColumn> columns_;
  std::optional<NativeChunks> chunks_;
  std::int64_t given_ = 0;       ///< rows of the present chunk, handed out
  std::int64_t rows_given_ = 0;  ///< since the beginning
  Issues issues_;
};

}  // namespace

bool looks_like_native(std::string_view head) { return head.find(kNativeMagic) != std::string_view::npos; }

std::unique_ptr<RawReader> open_native(std::unique_ptr<ByteSource> bytes) {
  return std::make_unique<NativeReader>(std::move(bytes));
}

}  // namespace faultline
