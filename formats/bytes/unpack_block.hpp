// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace faultline {

/// Compression of a block inside a file.
enum class BlockPacking { none, lz4_frame, zstd, bz2 };

/// Blocks larger than this are not unpacked; recorders write a few MiB.
inline constexpr std::uint64_t kLargestBlock = std::uint64_t{1} << 30;

/// Unpacks a whole block into `out`, of which `promised` bytes are expected. Memory grows with what comes
/// out, not with the promise. What could be unpacked before damage stays in `out`; whether all was sound and
/// as long as promised.
bool unpack_block(BlockPacking packing, std::string_view packed, std::uint64_t promised, std::string& out);

}  // namespace faultline
