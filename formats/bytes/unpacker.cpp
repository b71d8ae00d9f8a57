// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <new>
#include <string>
#include <string_view>
#include <utility>

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

/// Converts text in UTF-16, which begins with its byte-order mark, to UTF-8 without one. Half of a pair of
/// surrogates becomes U+FFFD.
class Utf16Text : public BufferedUnpacker {
 public:
  Utf16Text(FileBytes& file, bool high_first)
      : BufferedUnpacker(file, "UTF-16", kUtf16Byte_ns), high_first_(high_first) {}

  std::size_t read(char* to, std::size_t size) override {
    std::size_t written = 0;
    while (written < size) {
      if (at_ == text_.size() && !step()) break;
      const std::size_t now = std::min(size - written, text_.size() - at_);
      std::memcpy(to + written, text_.data() + at_, now);
      written += now;
      at_ += now;
    }
    return written;
  }

 private:
  static constexpr std::uint32_t kMark = 0xFEFF, kReplacement = 0xFFFD;
  static constexpr std::uint32_t kHighSurrogates = 0xD800, kLowSurrogates = 0xDC00,
                                 kBehindSurrogates = 0xE000;

  /// Converts the bytes in view to text_; false at the end.
  bool step() {
    text_.clear();
    at_ = 0;
    while (text_.empty() && !has_ended()) {
      const std::string_view view = packed();
      if (view.empty()) {
        if (high_surrogate_ != 0) put(kReplacement);
        high_surrogate_ = 0;
        end(has_half_ ? "the file is cut" : "");
        break;
      }
      for (const char byte : view) take_byte(static_cast<unsigned char>(byte));
      take(view.size());
    }
    return !text_.empty();
  }

  void take_byte(std::uint32_t byte) {
    has_half_ = !has_half_;
    if (has_half_)
      half_ = byte;
    else
      take_unit(high_first_ ? (half_ << 8) | byte : (byte << 8) | half_);
  }

  void take_unit(std::uint32_t unit) {
    const bool is_first = std::exchange(is_first_, false);
    if (is_first && unit == kMark) return;
    const bool is_low = unit >= kLowSurrogates && unit < kBehindSurrogates;
    if (const std::uint32_t high = std::exchange(high_surrogate_, 0); high != 0) {
      constexpr int kSurrogateBits = 10;
      constexpr std::uint32_t kFirstOfPairs = 0x10000;
      if (is_low)
        return put(kFirstOfPairs + ((high - kHighSurrogates) << kSurrogateBits) + (unit - kLowSurrogates));
      put(kReplacement);
    }
    if (unit >= kHighSurrogates && unit < kLowSurrogates)
      high_surrogate_ = unit;
    else
      put(is_low ? kReplacement : unit);
  }

  /// Appends a character in UTF-8.
  void put(std::uint32_t character) {
    constexpr std::uint32_t kOneByte = 0x80, kTwoBytes = 0x800,
                            kThreeBytes = 0x10000;  // first that need more
    constexpr int kBits = 6;                        // of a byte behind the first one
    const auto behind = [&](int bytes) {
      for (int i = bytes - 1; i >= 0; --i)
        text_ += static_cast<char>(0x80 | ((character >> (kBits * i)) & 0x3F));
    };
    if (character < kOneByte) {
      text_ += static_cast<char>(character);
    } else if (character < kTwoBytes) {
      text_ += static_cast<char>(0xC0 | (character >> kBits));
      behind(1);
    } else if (character < kThreeBytes) {
      text_ += static_cast<char>(0xE0 | (character >> (2 * kBits)));
      behind(2);
    } else {
      text_ += static_cast<char>(0xF0 | (character >> (3 * kBits)));
      behind(3);
    }
  }

  bool high_first_;
  std::string text_;                             ///< converted, in part handed out
  std::size_t at_ = 0;                           ///< bytes of it that were
  std::uint32_t half_ = 0, high_surrogate_ = 0;  ///< 0 for no surrogate
  bool has_half_ = false, is_first_ = true;
};

}  // namespace

std::unique_ptr<Unpacker> unpacker_of(FileBytes& file) {
  if (file.head().starts_with(kGzipMagic)) return std::make_unique<GzipUnpacker>(file);
  if (file.head().starts_with(kZstdMagic)) return std::make_unique<ZstdUnpacker>(file);
  if (file.head().starts_with("\xFF\xFE")) return std::make_unique<Utf16Text>(file, false);
  if (file.head().starts_with("\xFE\xFF")) return std::make_unique<Utf16Text>(file, true);
  return nullptr;
}

}  // namespace faultline
