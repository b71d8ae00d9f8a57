// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace faultline {

/// Compression of a block inside a file.
enum class BlockPacking { none, lz4_frame, zstd, bz2 };

/// Blocks larger than this, unpacked, are skipped (bytes); recorders write a few MiB.
inline constexpr std::uint64_t kLargestBlock = std::uint64_t{1} << 26;

/// Memory for an unpacked block, reused for the next one. Only the bytes that are filled are touched.
class BlockBytes {
 public:
  std::string_view view() const { return {bytes_.get(), size_}; }
  void clear() { size_ = 0; }
  /// Makes room for so many bytes; the old content is lost.
  char* make_room(std::size_t bytes) {
    if (bytes > capacity_) bytes_.reset(new char[capacity_ = bytes]);
    size_ = 0;
    return bytes_.get();
  }
  /// Sets the number of bytes that were filled.
  void set_size(std::size_t size) { size_ = std::min(size, capacity_); }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t capacity_ = 0, size_ = 0;
};

/// Unpacks a whole block into `out`; `promised` bytes are expected. Memory grows with the actual output, not
/// with the promise. Bytes unpacked before damage stay in `out`; true when the block is undamaged and as long
/// as promised.
bool unpack_block(BlockPacking packing, std::string_view packed, std::uint64_t promised, BlockBytes& out);

/// Returns the reason why a block of so many unpacked bytes was skipped, and what to do.
std::string too_large_block(std::uint64_t bytes);

/// Returns the work, ns, to unpack a block into so many bytes.
std::int64_t block_work_ns(BlockPacking packing, std::int64_t unpacked);

}  // namespace faultline
