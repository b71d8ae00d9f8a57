// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <new>
#include <string>
#include <string_view>

#include "formats/byte_source.hpp"
#include "formats/bytes/work_budget.hpp"

namespace faultline {
namespace {

/// Buffers the compressed bytes of a file for a library that consumes any number of those in view.
class PackedInput {
 public:
  explicit PackedInput(FileBytes& file) : file_(file), bytes_(kAtOnce, '\0') {}

  /// Bytes not yet taken; reads more when there are none. Empty at the end of the file.
  std::string_view view() {
    if (begin_ == end_) {
      begin_ = 0;
      end_ = file_.read(bytes_.data(), bytes_.size());
    }
    return {bytes_.data() + begin_, end_ - begin_};
  }
  void take(std::size_t size) {
    begin_ += size;
    position_ += static_cast<std::int64_t>(size);
  }
  /// Bytes taken since the beginning.
  std::int64_t position() const { return position_; }

 private:
  static constexpr std::size_t kAtOnce = 1 << 16;

  FileBytes& file_;
  std::string bytes_;
  std::size_t begin_ = 0, end_ = 0;
  std::int64_t position_ = 0;
};

constexpr std::string_view kGzipMagic = "\x1F\x8B\x08";
constexpr std::string_view kZstdMagic = "\x28\xB5\x2F\xFD";
constexpr int kGzipWindow = 15 + 16;          // largest window, gzip header (zlib.h)
constexpr std::size_t kMostAtOnce = 1 << 30;  // bytes that are unpacked at once
constexpr unsigned char kFirstByte = 0x1F;    // of a gzip member

/// Unpacks gzip; one member may follow another.
class GzipUnpacker : public Unpacker {
 public:
  explicit GzipUnpacker(FileBytes& file) : input_(file) {
    if (inflateInit2(&stream_, kGzipWindow) != Z_OK) throw std::bad_alloc();
  }
  ~GzipUnpacker() override { inflateEnd(&stream_); }
  GzipUnpacker(const GzipUnpacker&) = delete;
  GzipUnpacker& operator=(const GzipUnpacker&) = delete;

  const char* name() const override { return "gzip"; }
  double byte_ns() const override { return kDeflateByte_ns; }
  const std::string& damage() const override { return damage_; }

  std::size_t read(char* to, std::size_t size) override {
    size = std::min(size, kMostAtOnce);
    stream_.next_out = reinterpret_cast<Bytef*>(to);
    stream_.avail_out = static_cast<uInt>(size);
    while (!ended_ && stream_.avail_out == size && size > 0) step();
    return size - stream_.avail_out;
  }

 private:
  void step() {
    const std::string_view packed = input_.view();
    if (between_members_ && (packed.empty() || static_cast<unsigned char>(packed[0]) != kFirstByte))
      return end(packed.empty() ? "" : "bytes that are not gzip follow");
    if (packed.empty()) return end("the file is cut");
    if (between_members_) inflateReset(&stream_);
    between_members_ = false;
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream_.avail_in = static_cast<uInt>(packed.size());
    const int result = inflate(&stream_, Z_NO_FLUSH);
    input_.take(packed.size() - stream_.avail_in);
    if (result == Z_STREAM_END)
      between_members_ = true;
    else if (result != Z_OK && result != Z_BUF_ERROR)
      end("the compressed bytes are damaged");
  }

  void end(const char* why) {
    ended_ = true;
    if (*why == '\0') return;
    damage_ =
        fmt::format("the gzip stream: {} at byte {}; the data before it are read, the data after it are lost",
                    why, input_.position());
  }

  PackedInput input_;
  z_stream stream_{};
  bool between_members_ = false;
  bool ended_ = false;
  std::string damage_;
};

/// Unpacks zstd; one frame may follow another.
class ZstdUnpacker : public Unpacker {
 public:
  explicit ZstdUnpacker(FileBytes& file) : input_(file), stream_(ZSTD_createDStream()) {
    if (!stream_) throw std::bad_alloc();
  }
  ~ZstdUnpacker() override { ZSTD_freeDStream(stream_); }
  ZstdUnpacker(const ZstdUnpacker&) = delete;
  ZstdUnpacker& operator=(const ZstdUnpacker&) = delete;

  const char* name() const override { return "zstd"; }
  double byte_ns() const override { return kZstdByte_ns; }
  const std::string& damage() const override { return damage_; }

  std::size_t read(char* to, std::size_t size) override {
    ZSTD_outBuffer out{to, size, 0};
    while (!ended_ && out.pos == 0 && size > 0) step(out);
    return out.pos;
  }

 private:
  void step(ZSTD_outBuffer& out) {
    const std::string_view packed = input_.view();
    ZSTD_inBuffer in{packed.data(), packed.size(), 0};
    const std::size_t result = ZSTD_decompressStream(stream_, &out, &in);
    input_.take(in.pos);
    if (ZSTD_isError(result)) return end("the compressed bytes are damaged");
    if (packed.empty() && out.pos == 0) return end(inside_frame_ ? "the file is cut" : "");
    if (in.pos > 0 || result == 0) inside_frame_ = result != 0;
  }

  void end(const char* why) {
    ended_ = true;
    if (*why == '\0') return;
    damage_ =
        fmt::format("the zstd stream: {} at byte {}; the data before it are read, the data after it are lost",
                    why, input_.position());
  }

  PackedInput input_;
  ZSTD_DStream* stream_;
  bool inside_frame_ = false;
  bool ended_ = false;
  std::string damage_;
};

}  // namespace

std::unique_ptr<Unpacker> unpacker_of(FileBytes& file) {
  if (file.head().starts_with(kGzipMagic)) return std::make_unique<GzipUnpacker>(file);
  if (file.head().starts_with(kZstdMagic)) return std::make_unique<ZstdUnpacker>(file);
  return nullptr;
}

}  // namespace faultline
