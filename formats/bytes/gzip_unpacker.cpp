// SPDX-License-Identifier: MIT
#include "formats/bytes/gzip_unpacker.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <new>

#include "formats/bytes/packed_input.hpp"
#include "formats/bytes/work_budget.hpp"

namespace faultline {
namespace {

constexpr int kGzipWindow = 15 + 16;  // largest window, gzip header (zlib.h)
constexpr std::size_t kMostAtOnce = 1 << 30;
constexpr unsigned char kFirstByte = 0x1F;

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
      return end(packed.empty() ? "" : "bytes that are no gzip follow");
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
    damage_ = fmt::format(
        "the gzip stream: {} at byte {}; what was unpacked before is read, what comes "
        "behind is lost",
        why, input_.position());
  }

  PackedInput input_;
  z_stream stream_{};
  bool between_members_ = false;
  bool ended_ = false;
  std::string damage_;
};

}  // namespace

std::unique_ptr<Unpacker> unpack_gzip(FileBytes& file) { return std::make_unique<GzipUnpacker>(file); }

}  // namespace faultline
