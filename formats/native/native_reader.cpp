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
#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

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
