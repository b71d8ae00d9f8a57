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

constexpr std::string_view kGzipMagic = "\x1F\x8B\x08";
constexpr std::string_view kZstdMagic = "\x28\xB5\x2F\xFD";
constexpr int kGzipWindow = 15 + 16;          // largest window, gzip header (zlib.h)
constexpr std::size_t kMostAtOnce = 1 << 30;  // bytes that are unpacked at once
constexpr unsigned char kFirstByte = 0x1F;    // of a gzip member

/// Buffers the compressed bytes of a file for a library that consumes any number of those in view, and notes
/// how they end.
class BufferedUnpacker : public Unpacker {
 protected:
  BufferedUnpacker(FileBytes& file, const char* name, double byte_ns)
      : Unpacker(name, byte_ns), file_(file), bytes_(kAtOnce, '\0') {}

  /// Bytes not yet taken; reads more when there are none. Empty at the end of the file.
  std::string_view packed() {
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
  bool has_ended() const { return ended_; }
  /// Ends the unpacked bytes; `why` is the damage, empty for none.
  void end(const char* why) {
    ended_ = true;
    if (*why == '\0') return;
    damage_ =
        fmt::format("the {} stream: {} at byte {}; the data before it are read, the data after it are lost",
                    name(), why, position_);
  }

 private:
  static constexpr std::size_t kAtOnce = 1 << 16;

  FileBytes& file_;
  std::string bytes_;
  std::size_t begin_ = 0, end_ = 0;
  std::int64_t position_ = 0;  ///< bytes taken since the beginning
  bool ended_ = false;
};

/// Unpacks gzip; one member may follow another.
class GzipUnpacker : public BufferedUnpacker {
 public:
  explicit GzipUnpacker(FileBytes& file) : BufferedUnpacker(file, "gzip", kDeflateByte_ns) {
    if (inflateInit2(&stream_, kGzipWindow) != Z_OK) throw std::bad_alloc();
  }
  ~GzipUnpacker() override { inflateEnd(&stream_); }
  GzipUnpacker(const GzipUnpacker&) = delete;
  GzipUnpacker& operator=(const GzipUnpacker&) = delete;

  std::size_t read(char* to, std::size_t size) override {
    size = std::min(size, kMostAtOnce);
    stream_.next_out = reinterpret_cast<Bytef*>(to);
    stream_.avail_out = static_cast<uInt>(size);
    while (!has_ended() && stream_.avail_out == size && size > 0) step();
    return size - stream_.avail_out;
  }

 private:
  void step() {
    const std::string_view view = packed();
    if (between_members_ && (view.empty() || static_cast<unsigned char>(view[0]) != kFirstByte))
      return end(view.empty() ? "" : "bytes that are not gzip follow");
    if (view.empty()) return end("the file is cut");
    if (between_members_) inflateReset(&stream_);
    between_members_ = false;
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(view.data()));
    stream_.avail_in = static_cast<uInt>(view.size());
    const int result = inflate(&stream_, Z_NO_FLUSH);
    take(view.size() - stream_.avail_in);
    if (result == Z_STREAM_END)
      between_members_ = true;
    else if (result != Z_OK && result != Z_BUF_ERROR)
      end("the compressed bytes are damaged");
  }

  z_stream stream_{};
  bool between_members_ = false;
};

/// Unpacks zstd; one frame may follow another.
class ZstdUnpacker : public BufferedUnpacker {
 public:
  explicit ZstdUnpacker(FileBytes& file)
      : BufferedUnpacker(file, "zstd", kZstdByte_ns), stream_(ZSTD_createDStream()) {
    if (!stream_) throw std::bad_alloc();
  }
  ~ZstdUnpacker() override { ZSTD_freeDStream(stream_); }
  ZstdUnpacker(const ZstdUnpacker&) = delete;
  ZstdUnpacker& operator=(const ZstdUnpacker&) = delete;

  std::size_t read(char* to, std::size_t size) override {
    ZSTD_outBuffer out{to, size, 0};
    while (!has_ended() && out.pos == 0 && size > 0) step(out);
    return out.pos;
  }

 private:
  void step(ZSTD_outBuffer& out) {
    const std::string_view view = packed();
    ZSTD_inBuffer in{view.data(), view.size(), 0};
    const std::size_t result = ZSTD_decompressStream(stream_, &out, &in);
    take(in.pos);
    if (ZSTD_isError(result)) return end("the compressed bytes are damaged");
    if (view.empty() && out.pos == 0) return end(inside_frame_ ? "the file is cut" : "");
    if (in.pos > 0 || result == 0) inside_frame_ = result != 0;
  }

  ZSTD_DStream* stream_;
  bool inside_frame_ = false;
};

}  // namespace

std::unique_ptr<Unpacker> unpacker_of(FileBytes& file) {
  if (file.head().starts_with(kGzipMagic)) return std::make_unique<GzipUnpacker>(file);
  if (file.head().starts_with(kZstdMagic)) return std::make_unique<ZstdUnpacker>(file);
  return nullptr;
}

}  // namespace faultline
