// SPDX-License-Identifier: MIT
#include "formats/native_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "formats/native_layout.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kLongestList = 1 << 22;

class NativeReader : public RawReader {
 public:
  explicit NativeReader(std::unique_ptr<ByteSource> bytes) : bytes_(std::move(bytes)) {
    identity_.path = bytes_->path();
    identity_.format = "native";
    read_preface();
    wanted_.assign(columns_.size(), true);
  }

  const std::vector<RawColumn>& columns() const override { return columns_; }
  void want(const std::vector<bool>& columns) override { wanted_ = columns; }
  const LogIdentity& identity() const override { return identity_; }
  const Issues& issues() const override { return issues_; }
  bool canonical() const override { return true; }
  double share_read() const override { return bytes_->share_read(); }

  bool next(RawBlock& block, int max_rows) override {
    if (given_ == rows_ && !read_chunk()) {
      identity_.sha256 = bytes_->sha256();
      return false;
    }
    block.rows = static_cast<int>(std::min<std::size_t>(rows_ - given_, max_rows));
    block.first_row = expected_row_ - rows_ + given_;
    block.columns.resize(columns_.size());
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const double* from = numbers_.data() + c * rows_ + given_;
      if (wanted_[c]) block.columns[c].assign(from, from + block.rows);
    }
    given_ += block.rows;
    identity_.rows_read += block.rows;
    return true;
  }

  void rewind() override {
    bytes_->rewind();
    issues_ = {};
    identity_.rows_read = 0;
    expected_row_ = rows_ = given_ = 0;
    finished_ = false;
    read_preface();
  }

 private:
  bool read_exactly(void* to, std::size_t size) {
    std::size_t got = 0;
    for (std::size_t more; got < size && (more = bytes_->read(static_cast<char*>(to) + got, size - got)) > 0;)
      got += more;
    bytes_read_ = got;
    return got == size;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::input, bytes_->path(), what);
  }

  void read_preface();
  bool read_chunk();
  bool find_header(NativeChunkHeader& header);
  bool read_numbers(const NativeChunkHeader& header);
  void lose(const char* code, std::int64_t rows, const std::string& what);
  bool finish();

  std::unique_ptr<ByteSource> bytes_;
  std::vector<RawColumn> columns_;
  std::vector<bool> wanted_;
  std::vector<double> numbers_;    ///< of the present chunk, column after column
  std::int64_t rows_ = 0;          ///< in the present chunk
  std::int64_t given_ = 0;         ///< of these, handed out
  std::int64_t expected_row_ = 0;  ///< first row of the next chunk
  std::size_t bytes_read_ = 0;     ///< by the last read_exactly()
  bool finished_ = false;
  LogIdentity identity_;
  Issues issues_;
};

void NativeReader::read_preface() {
  NativePreface preface;
  if (!read_exactly(&preface, sizeof preface)) fail("is cut inside its header; nothing can be read from it");
  if (preface.version > kNativeVersion)
    fail(fmt::format("is of format version {}, this program reads up to {}; use a newer faultline",
                     preface.version, kNativeVersion));
  std::string bytes(reinterpret_cast<const char*>(&preface), sizeof preface);
  std::uint64_t hash = 0;
  const bool sane = preface.version == kNativeVersion && preface.list_bytes <= kLongestList;
  bytes.resize(sizeof preface + (sane ? preface.list_bytes : 0));
  const bool whole = sane && read_exactly(bytes.data() + sizeof preface, preface.list_bytes) &&
                     read_exactly(&hash, sizeof hash) && hash == native_hash(bytes);
  if (!whole) fail("has a damaged header (its checksum does not match); nothing can be read from it");
  columns_.clear();
  for (std::size_t begin = sizeof preface; begin < bytes.size();) {
    const auto tab = bytes.find('\t', begin), end = bytes.find('\n', begin);
    if (tab >= end || end == std::string::npos) fail("has a channel list that cannot be read");
    columns_.push_back({bytes.substr(begin, tab - begin), bytes.substr(tab + 1, end - tab - 1)});
    begin = end + 1;
  }
}

void NativeReader::lose(const char* code, std::int64_t rows, const std::string& what) {
  issues_.add({code, "", Severity::severe, fmt::format("after row {}: {}", expected_row_, what),
               expected_row_ + 1, kNan, 1, rows});
  identity_.rows_read += rows;
}

/// The next sound chunk header; when bytes are damaged, the next one that can be found behind them.
bool NativeReader::find_header(NativeChunkHeader& header) {
  char bytes[sizeof header];
  std::size_t have = 0, skipped = 0;
  while (read_exactly(bytes + have, sizeof bytes - have)) {
    std::memcpy(&header, bytes, sizeof header);
    if (is_sound(header)) {
      const std::int64_t missing = static_cast<std::int64_t>(header.first_row) - expected_row_;
      if (skipped > 0 || missing != 0)
        lose("chunk_damaged", std::max<std::int64_t>(missing, 0),
             fmt::format("{} bytes are damaged; {} rows were left out", skipped, missing));
      expected_row_ = static_cast<std::int64_t>(header.first_row);
      return true;
    }
    std::memmove(bytes, bytes + 1, sizeof bytes - 1);
    have = sizeof bytes - 1;
    ++skipped;
  }
  lose("file_truncated", 0,
       fmt::format("the file ends without its end mark; {} bytes behind the last whole chunk were left out",
                   skipped + have + bytes_read_));
  return false;
}

bool NativeReader::read_chunk() {
  while (!finished_) {
    NativeChunkHeader header;
    if (!find_header(header) || header.marker == kEndMarker) return finish();
    if (read_numbers(header)) return true;
  }
  return false;
}

bool NativeReader::read_numbers(const NativeChunkHeader& header) {
  numbers_.resize(header.rows * columns_.size());
  const std::size_t size = numbers_.size() * sizeof(double);
  rows_ = given_ = 0;
  if (!read_exactly(numbers_.data(), size)) {
    lose("file_truncated", header.rows,
         fmt::format("the file is cut inside a chunk; its {} rows were left out", header.rows));
    finish();
    return false;
  }
  const bool sound = native_hash({reinterpret_cast<const char*>(numbers_.data()), size}) == header.data_hash;
  if (!sound)
    lose("chunk_damaged", header.rows,
         fmt::format("the checksum of a chunk does not match; its {} rows were left out", header.rows));
  expected_row_ += header.rows;
  if (sound) rows_ = header.rows;
  return sound;
}

/// Reads what may follow, so that the hash covers the whole file.
bool NativeReader::finish() {
  finished_ = true;
  char rest[4096];
  std::int64_t more = 0;
  for (std::size_t got; (got = bytes_->read(rest, sizeof rest)) > 0;) more += static_cast<std::int64_t>(got);
  if (more > 0)
    issues_.add({"trailing_bytes", "", Severity::warning,
                 fmt::format("{} bytes behind the end mark were not looked at", more)});
  return false;
}

}  // namespace

bool looks_like_native(std::string_view head) { return head.substr(0, kNativeMagic.size()) == kNativeMagic; }

std::unique_ptr<RawReader> open_native(std::unique_ptr<ByteSource> bytes) {
  return std::make_unique<NativeReader>(std::move(bytes));
}

}  // namespace faultline
