// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/arrays/stored_content.hpp"
#include "formats/bytes/work_budget.hpp"
#include "formats/diadem/diadem_files.hpp"
#include "formats/diadem/diadem_header.hpp"
#include "formats/diadem/diadem_table.hpp"
#include "formats/known_formats.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/text.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

/// Longest header, bytes: that of the most channels takes some MB.
constexpr std::size_t kMostDiademHeader = 1 << 24;
/// Values and bytes that are read at once.
constexpr std::int64_t kDiademBlockValues = 1 << 19, kDiademBlockBytes = 1 << 24;

std::string read_header_text(ByteSource& bytes) {
  std::string text;
  for (std::size_t got = 1; got > 0;) {
    constexpr std::size_t kDataPiece = 1 << 16;  // bytes
    const std::size_t before = text.size();
    text.resize(before + kDataPiece);
    got = bytes.read(text.data() + before, kDataPiece);
    text.resize(before + got);
    if (text.size() > kMostDiademHeader)
      throw Error(
          ErrorCode::input, bytes.path(),
          fmt::format("begins as a DIAdem header, but has more than the {} MiB that one can have; give "
                      "the header (.dat) of the recording, not its data",
                      kMostDiademHeader >> 20));
  }
  return text;
}

template <typename Element>
double diadem_element(const char* from, bool swapped) {
  std::array<char, sizeof(Element)> bytes;
  std::memcpy(bytes.data(), from, sizeof(Element));
  if (swapped) std::reverse(bytes.begin(), bytes.end());
  Element element;
  std::memcpy(&element, bytes.data(), sizeof element);
  return static_cast<double>(element);
}

double diadem_value(const char* from, DiademType type, bool swapped) {
  switch (type) {
    case DiademType::real64:
      return diadem_element<double>(from, swapped);
    case DiademType::real32:
      return diadem_element<float>(from, swapped);
    case DiademType::int16:
      return diadem_element<std::int16_t>(from, swapped);
    case DiademType::int32:
      return diadem_element<std::int32_t>(from, swapped);
  }
  return kNan;
}

class DiademReader : public RawReader {
 public:
  explicit DiademReader(std::unique_ptr<ByteSource> bytes) {
    identity_.path = bytes->path();
    identity_.format = "diadem";
    std::error_code error;
    if (!std::filesystem::is_regular_file(identity_.path, error))
      throw Error(
          ErrorCode::input, identity_.path,
          "is a pipe or a device, but the data files of a DIAdem header are found in its folder; give "
          "the path of the header");
    DiademHeader header = read_diadem_header(read_header_text(*bytes), identity_.path);
    table_ = diadem_table(header, identity_.path);
    swapped_ = header.big_endian;
    missing_ = header.missing;
    opening_ = bytes->issues();
    opening_.merge(table_.issues);
    std::int64_t all_bytes = bytes->file_size();
    for (const DiademFile& file : table_.files) all_bytes += file.bytes;
    WorkBudget(identity_.path).spend(table_work_ns(table_.rows_held, std::ssize(table_.columns)), all_bytes);
    wanted_.assign(table_.columns.size(), true);
    for (const DiademColumn& place : table_.places)
      if (place.in_blocks) widest_row_ = std::max(widest_row_, place.stride);
    issues_ = opening_;
  }

  const std::vector<RawColumn>& columns() const override { return table_.columns; }
  const Issues& issues() const override { return issues_; }
  double share_read() const override {
    return static_cast<double>(given_) / static_cast<double>(table_.rows_held);
  }

  bool next(RawBlock& block, int max_rows) override {
    const std::int64_t at_once =
        std::min(kDiademBlockValues / std::ssize(table_.columns), kDiademBlockBytes / widest_row_);
    block.first_row = given_;
    block.rows = static_cast<int>(std::min({static_cast<std::int64_t>(max_rows),
                                            std::max<std::int64_t>(at_once, 1), table_.rows_held - given_}));
    block.columns.resize(table_.columns.size());
    for (std::vector<double>& column : block.columns) column.clear();
    if (block.rows <= 0) {
      finish();
      return false;
    }
    open();
    for (std::size_t c = 0; c < table_.columns.size(); ++c)
      if (wanted_[c]) fill(table_.places[c], block.columns[c], block.rows);
    given_ += block.rows;
    identity_.rows_read = given_;
    return true;
  }

  void rewind() override {
    issues_ = opening_;
    open_.clear();
    given_ = identity_.rows_read = 0;
    at_end_ = false;
  }

 private:
  /// A data file that is being read, with the rows of blocks that were read last.
  struct OpenFile {
    std::unique_ptr<RandomFile> file;
    std::int64_t first_row = -1, rows = 0;
    std::vector<char> blocks;
  };

  [[noreturn]] void fail_data(const DiademFile& data, const std::string& what) const {
    const std::string name = std::filesystem::path(data.path).filename().string();
    throw Error(ErrorCode::input, identity_.path,
                fmt::format("has the data file \"{}\", which {}", shortened(name, kLongestName), what));
  }

  [[noreturn]] void fail_changed(const DiademFile& data) const {
    fail_data(data, "was replaced or changed while it was read; run again when it is complete");
  }

  void open() {
    if (!open_.empty()) return;
    for (const DiademFile& data : table_.files) {
      try {
        open_.push_back({std::make_unique<RandomFile>(data.path), -1, 0, {}});
      } catch (const Error& error) {
        fail_data(data, error.message());
      }
      if (open_.back().file->size() != data.bytes) fail_changed(data);
    }
  }

  void read(int file, std::int64_t at, char* to, std::int64_t count) {
    const auto index = static_cast<std::size_t>(file);
    const auto bytes = static_cast<std::size_t>(count);
    if (open_[index].file->read(at, to, bytes) != bytes) fail_changed(table_.files[index]);
  }

  void fill(const DiademColumn& place, std::vector<double>& values, int rows) {
    values.assign(static_cast<std::size_t>(rows), kNan);
    if (place.file < 0) {
      for (std::int64_t i = 0; i < rows; ++i)
        values[static_cast<std::size_t>(i)] = place.start + static_cast<double>(given_ + i) * place.step;
      return;
    }
    const std::int64_t held = std::clamp<std::int64_t>(place.held - given_, 0, rows);
    if (held == 0) return;
    const char* from = place.in_blocks ? blocks_at(place, rows) + place.begin : values_at(place, held);
    for (std::int64_t i = 0; i < held; ++i, from += place.stride) {
      const double value = diadem_value(from, place.type, swapped_);
      values[static_cast<std::size_t>(i)] = value == missing_ ? kNan : value * place.step + place.start;
    }
  }

  /// Returns the next values of a column that is stored alone.
  const char* values_at(const DiademColumn& place, std::int64_t count) {
    column_.resize(static_cast<std::size_t>(count * place.stride));
    read(place.file, place.begin + given_ * place.stride, column_.data(), count * place.stride);
    return column_.data();
  }

  /// Returns the next rows of a file of blocks; the last one may be cut.
  const char* blocks_at(const DiademColumn& place, std::int64_t rows) {
    OpenFile& open = open_[static_cast<std::size_t>(place.file)];
    if (open.first_row == given_ && open.rows == rows) return open.blocks.data();
    const std::int64_t at = given_ * place.stride,
                       bytes = std::min(rows * place.stride,
                                        table_.files[static_cast<std::size_t>(place.file)].bytes - at);
    open.blocks.resize(static_cast<std::size_t>(bytes));
    read(place.file, at, open.blocks.data(), bytes);
    open.first_row = given_;
    open.rows = rows;
    return open.blocks.data();
  }

  /// Reports the rows that the data files lack, and computes the hash of header and data files.
  void finish() {
    if (std::exchange(at_end_, true)) return;
    open_.clear();
    const std::int64_t cut = table_.rows - table_.rows_held;
    if (cut > 0)
      issues_.add(
          {"file_truncated", "", Severity::severe,
           fmt::format("from row {} on: the data files end before the {} rows that the header states; {} "
                       "were left out",
                       table_.rows_held + 1, table_.rows, cut),
           table_.rows_held + 1, kNan, 1, cut});
    identity_.rows_read = table_.rows;
    std::vector<std::string> paths{identity_.path};
    for (const DiademFile& data : table_.files) paths.push_back(data.path);
    identity_.sha256 = sha256_of_files(paths);
  }

  DiademTable table_;
  bool swapped_ = false;         ///< the byte order is not the processor's
  double missing_ = kNan;        ///< stored in place of a missing value
  std::int64_t widest_row_ = 1;  ///< of blocks, bytes
  std::vector<OpenFile> open_;   ///< by data file; empty unless rows are being read
  std::vector<char> column_;
  std::int64_t given_ = 0;  ///< rows handed out so far
  bool at_end_ = false;
  Issues opening_;  ///< issues found on opening
  Issues issues_;
};

}  // namespace

bool looks_like_diadem(std::string_view head) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (head.starts_with(kByteOrderMark)) head.remove_prefix(kByteOrderMark.size());
  head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
  return head.starts_with("DIAEXTENDED") || head.starts_with("#BEGINGLOBALHEADER") ||
         head.starts_with("#BEGINCHANNELHEADER");
}

std::unique_ptr<RawReader> open_diadem(std::unique_ptr<ByteSource> bytes) {
  return std::make_unique<DiademReader>(std::move(bytes));
}

std::vector<std::string> files_beside_diadem(ByteSource& bytes) {
  return diadem_data_files(read_diadem_header(read_header_text(bytes), bytes.path()), bytes.path());
}

}  // namespace faultline
