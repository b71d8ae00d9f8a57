// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace faultline {

/// Kinds of records of an MCAP file (mcap.dev/spec).
enum class McapOp : unsigned char {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  statistics = 0x0B,
  metadata = 0x0C,
  data_end = 0x0F,
};

inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};
/// Bytes of a record before its content: kind and length.
inline constexpr std::size_t kMcapRecordHead = 9;

/// True for the kinds of the specification; others are of a later version or damaged.
constexpr bool is_mcap_op(unsigned char op) { return op >= 0x01 && op <= 0x0F; }

}  // namespace faultline
