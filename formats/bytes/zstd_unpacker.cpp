// SPDX-License-Identifier: MIT
#include "formats/bytes/zstd_unpacker.hpp"

#include <fmt/format.h>
#include <zstd.h>

#include <new>

#include "formats/bytes/packed_input.hpp"
#include "formats/bytes/work_budget.hpp"

namespace faultline {
namespace {

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
    damage_ = fmt::format(
        "the zstd stream: {} at byte {}; what was unpacked before is read, what comes "
        "behind is lost",
        why, input_.position());
  }

  PackedInput input_;
  ZSTD_DStream* stream_;
  bool inside_frame_ = false;
  bool ended_ = false;
  std::string damage_;
};

}  // namespace

std::unique_ptr<Unpacker> unpack_zstd(FileBytes& file) { return std::make_unique<ZstdUnpacker>(file); }

}  // namespace faultline
