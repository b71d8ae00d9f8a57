// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "formats/known_formats.hpp"
#include "formats/log_writer.hpp"
#include "formats/native/native_layout.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::size_t kWrittenAtOnce = 1 << 18;

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\t' || c == '\n'; }, ' ');
  return text;
}

class NativeWriter : public LogWriter {
 public:
  explicit NativeWriter(const std::string& path) : path_(path), file_(path) {}

  void write(const Log& segment) override {
    const auto channels = channels_of(segment);
    if (channels_ == 0) write_preface(channels);
    if (channels.size() != channels_)
      throw Error(ErrorCode::internal, path_, "segments of one log must have the same channels");
    for (std::size_t done = 0; done < channels[0].values->size();) {
      if (rows_ == 0) begin_chunk();
      const std::size_t now = std::min<std::size_t>(most_rows_ - rows_, channels[0].values->size() - done);
      for (std::size_t c = 0; c < channels_; ++c)
        std::memcpy(place(c * most_rows_ + rows_), channels[c].values->data() + done, now * sizeof(double));
      rows_ += static_cast<std::uint32_t>(now);
      done += now;
      if (rows_ == most_rows_) end_chunk();
    }
  }

  void note_provenance(const std::string& provenance) override {
    if (rows_ > 0) end_chunk();
    reserve(sizeof(NativeChunkHeader));
    put_header({kProvenanceMarker, static_cast<std::uint32_t>(provenance.size()), rows_written_,
                native_hash(provenance), 0});
    put(provenance);
  }

  void commit() override {
    if (rows_ > 0) end_chunk();
    reserve(sizeof(NativeChunkHeader));
    put_header({kEndMarker, 0, rows_written_, 0, 0});
    flush();
    file_.commit();
  }

 private:
  void write_preface(const std::vector<WrittenChannel>& channels) {
    std::string list;
    for (const WrittenChannel& channel : channels)
      list += one_line(channel.name) + '\t' + one_line(channel.unit) + '\n';
    if (channels.size() > kMostChannels || list.size() > kLongestList)
      throw Error(
          ErrorCode::output, path_,
          fmt::format("cannot hold {} columns: a .flog holds at most {}, with at most {} bytes of names "
                      "and units; write .csv",
                      channels.size(), kMostChannels, kLongestList));
    channels_ = channels.size();
    const std::string preface = native_preface(list);
    put(preface);
    put(preface);
  }

  /// Makes room for so many more bytes in out_.
  void reserve(std::size_t bytes) {
    if (used_ >= kWrittenAtOnce) flush();
    if (used_ + bytes > out_.size()) out_.resize(used_ + bytes);
  }

  void put(std::string_view bytes) {
    reserve(bytes.size());
    std::memcpy(out_.data() + used_, bytes.data(), bytes.size());
    used_ += bytes.size();
  }

  void flush() {
    file_.write({out_.data(), used_});
    used_ = 0;
  }

  /// Returns the address of a number of the chunk that is being filled.
  char* place(std::size_t index) {
    return out_.data() + used_ + sizeof(NativeChunkHeader) + index * sizeof(double);
  }

  void begin_chunk() {
    most_rows_ = native_chunk_rows(rows_written_);
    reserve(sizeof(NativeChunkHeader) + channels_ * most_rows_ * sizeof(double));
  }

  void end_chunk() {
    for (std::size_t c = 1; c < channels_ && rows_ < most_rows_; ++c)  // shorter last chunk: close the gaps
      std::memmove(place(c * rows_), place(c * most_rows_), rows_ * sizeof(double));
    const std::size_t bytes = channels_ * rows_ * sizeof(double);
    put_header({kChunkMarker, rows_, rows_written_, native_hash({place(0), bytes}), 0});
    used_ += bytes;
    rows_written_ += rows_;
    rows_ = 0;
  }

  void put_header(NativeChunkHeader header) {
    header.own_hash = hash_of(header);
    std::memcpy(out_.data() + used_, &header, sizeof header);
    used_ += sizeof header;
  }

  std::string path_;
  AtomicFile file_;
  std::size_t channels_ = 0;
  std::vector<char> out_;        ///< unwritten bytes, and the chunk that is being filled
  std::size_t used_ = 0;         ///< start of that chunk in out_
  std::uint32_t most_rows_ = 0;  ///< of the chunk
  std::uint32_t rows_ = 0;       ///< in it; 0 when none is being filled
  std::uint64_t rows_written_ = 0;
};

}  // namespace

std::unique_ptr<LogWriter> create_native(const std::string& path) {
  return std::make_unique<NativeWriter>(path);
}

}  // namespace faultline
