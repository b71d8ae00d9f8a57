// SPDX-License-Identifier: MIT
#include "formats/native/native_reader.hpp"

#include <algorithm>
#include <optional>

#include "formats/native/native_chunks.hpp"
#include "formats/native/native_layout.hpp"
#include "formats/native/native_preface.hpp"

namespace faultline {
namespace {

class NativeReader : public RawReader {
 public:
  explicit NativeReader(std::unique_ptr<ByteSource> bytes) : bytes_(std::move(bytes)), window_(*bytes_) {
    identity_.path = bytes_->path();
    identity_.format = "native";
    start();
    wanted_.assign(columns_.size(), true);
  }

  const std::vector<RawColumn>& columns() const override { return columns_; }
  void want(const std::vector<bool>& columns) override { wanted_ = columns; }
  const LogIdentity& identity() const override { return identity_; }
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
      if (row != block.first_row + block.rows) break;  // rows of a block follow each other
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
  std::vector<bool> wanted_;
  std::optional<NativeChunks> chunks_;
  std::int64_t given_ = 0;       ///< rows of the present chunk, handed out
  std::int64_t rows_given_ = 0;  ///< since the beginning
  LogIdentity identity_;
  Issues issues_;
};

}  // namespace

bool looks_like_native(std::string_view head) { return head.find(kNativeMagic) != std::string_view::npos; }

std::unique_ptr<RawReader> open_native(std::unique_ptr<ByteSource> bytes) {
  return std::make_unique<NativeReader>(std::move(bytes));
}

}  // namespace faultline
