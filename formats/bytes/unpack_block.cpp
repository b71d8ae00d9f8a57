// SPDX-License-Identifier: MIT
#include "formats/bytes/unpack_block.hpp"

#include <bzlib.h>
#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

#include "formats/bytes/work_budget.hpp"

namespace faultline {
namespace {

/// Result of one step of a library.
struct Step {
  std::size_t taken = 0, made = 0;
  bool failed = false, ended = false;
};

/// Calls `step(in, in_size, out, out_size)` until its end, a failure, the end of `packed`, or `promised`
/// bytes of output.
template <typename StepOnce>
bool unpack_in_steps(std::string_view packed, std::uint64_t promised, BlockBytes& out, StepOnce step) {
  char* const to = out.make_room(promised);
  std::size_t made = 0;
  bool sound = true;
  while (made < promised) {
    const Step done = step(packed.data(), packed.size(), to + made, promised - made);
    packed.remove_prefix(done.taken);
    made += done.made;
    sound = !done.failed;
    if (done.failed || done.ended || (done.taken == 0 && done.made == 0)) break;
  }
  out.set_size(made);
  return sound && made == promised;
}

bool unpack_zstd_block(std::string_view packed, std::uint64_t promised, BlockBytes& out) {
  const std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream(ZSTD_createDStream(),
                                                                             ZSTD_freeDStream);
  return unpack_in_steps(
      packed, promised, out, [&](const char* in, std::size_t in_size, char* to, std::size_t room) {
        ZSTD_inBuffer from{in, in_size, 0};
        ZSTD_outBuffer into{to, room, 0};
        const bool failed = ZSTD_isError(ZSTD_decompressStream(stream.get(), &into, &from));
        return Step{from.pos, into.pos, failed, false};
      });
}

bool unpack_lz4_block(std::string_view packed, std::uint64_t promised, BlockBytes& out) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION))) return false;
  const std::unique_ptr<LZ4F_dctx, std::size_t (*)(LZ4F_dctx*)> owner(context, LZ4F_freeDecompressionContext);
  return unpack_in_steps(
      packed, promised, out, [&](const char* in, std::size_t in_size, char* to, std::size_t room) {
        Step done{in_size, room};
        done.failed = LZ4F_isError(LZ4F_decompress(context, to, &done.made, in, &done.taken, nullptr));
        if (done.failed) done.made = done.taken = 0;
        return done;
      });
}

bool unpack_bz2_block(std::string_view packed, std::uint64_t promised, BlockBytes& out) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) return false;
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> owner(&stream, BZ2_bzDecompressEnd);
  return unpack_in_steps(packed, promised, out,
                         [&](const char* in, std::size_t in_size, char* to, std::size_t room) {
                           const auto take = static_cast<unsigned>(in_size);
                           const auto give = static_cast<unsigned>(room);
                           stream.next_in = const_cast<char*>(in);
                           stream.avail_in = take;
                           stream.next_out = to;
                           stream.avail_out = give;
                           const int result = BZ2_bzDecompress(&stream);
                           return Step{take - stream.avail_in, give - stream.avail_out,
                                       result != BZ_OK && result != BZ_STREAM_END, result == BZ_STREAM_END};
                         });
}

}  // namespace

bool unpack_block(BlockPacking packing, std::string_view packed, std::uint64_t promised, BlockBytes& out) {
  out.clear();
  if (promised > kLargestBlock || packed.size() > kLargestBlock) return false;
  switch (packing) {
    case BlockPacking::none:
      std::copy(packed.begin(), packed.end(), out.make_room(packed.size()));
      out.set_size(packed.size());
      return packed.size() == promised;
    case BlockPacking::lz4_frame:
      return unpack_lz4_block(packed, promised, out);
    case BlockPacking::zstd:
      return unpack_zstd_block(packed, promised, out);
    case BlockPacking::bz2:
      return unpack_bz2_block(packed, promised, out);
  }
  return false;
}

std::string too_large_block(std::uint64_t bytes) {
  return fmt::format(
      "it takes {} MiB, more than the {} MiB that can be read at once; write the recording again in "
      "smaller chunks",
      bytes >> 20, kLargestBlock >> 20);
}

std::int64_t block_work_ns(BlockPacking packing, std::int64_t unpacked) {
  constexpr double kByte_ns[] = {0.0, kLz4Byte_ns, kZstdByte_ns,
                                 kBz2Byte_ns};  // in the order of BlockPacking
  return unpack_work_ns(kByte_ns[static_cast<std::size_t>(packing)], unpacked);
}

}  // namespace faultline
