// SPDX-License-Identifier: MIT
#include "formats/native_writer.hpp"

#include <algorithm>
#include <cstring>

#include "formats/channel_list.hpp"
#include "formats/native_layout.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

template <typename Value>
std::string_view bytes_of(const Value& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

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
      const std::size_t now = std::min<std::size_t>(kChunkRows - rows_, channels[0].values->size() - done);
      for (std::size_t c = 0; c < channels_; ++c)
        std::copy_n(channels[c].values->data() + done, now, numbers_.data() + c * kChunkRows + rows_);
      rows_ += static_cast<std::uint32_t>(now);
      done += now;
      if (rows_ == kChunkRows) write_chunk();
    }
  }

  void commit() override {
    if (rows_ > 0) write_chunk();
    NativeChunkHeader end{kEndMarker, 0, rows_written_, 0, 0};
    end.own_hash = hash_of(end);
    file_.write(bytes_of(end));
    file_.commit();
  }

 private:
  void write_preface(const std::vector<WrittenChannel>& channels) {
    std::string list;
    for (const WrittenChannel& channel : channels)
      list += one_line(channel.name) + '\t' + one_line(channel.unit) + '\n';
    NativePreface preface;
    std::copy(kNativeMagic.begin(), kNativeMagic.end(), preface.magic.begin());
    preface.list_bytes = static_cast<std::uint32_t>(list.size());
    const std::string bytes = std::string(bytes_of(preface)) + list;
    file_.write(bytes);
    file_.write(bytes_of(native_hash(bytes)));
    channels_ = channels.size();
    numbers_.resize(channels_ * kChunkRows);
  }

  void write_chunk() {
    for (std::size_t c = 1; c < channels_ && rows_ < kChunkRows; ++c)  // close ranks of a shorter last chunk
      std::memmove(numbers_.data() + c * rows_, numbers_.data() + c * kChunkRows, rows_ * sizeof(double));
    const std::string_view numbers{reinterpret_cast<const char*>(numbers_.data()),
                                   channels_ * rows_ * sizeof(double)};
    NativeChunkHeader header{kChunkMarker, rows_, rows_written_, native_hash(numbers), 0};
    header.own_hash = hash_of(header);
    file_.write(bytes_of(header));
    file_.write(numbers);
    rows_written_ += rows_;
    rows_ = 0;
  }

  std::string path_;
  AtomicFile file_;
  std::size_t channels_ = 0;
  std::vector<double> numbers_;  ///< of the chunk being filled, kChunkRows a channel
  std::uint32_t rows_ = 0;       ///< in it
  std::uint64_t rows_written_ = 0;
};

}  // namespace

std::unique_ptr<LogWriter> create_native(const std::string& path) {
  return std::make_unique<NativeWriter>(path);
}

}  // namespace faultline
