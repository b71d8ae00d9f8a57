// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/bytes/little_endian.hpp"
#include "formats/mcap/mcap_record.hpp"
#include "lib/core/atomic_file.hpp"

namespace faultline {

/// The declaration of a channel in an MCAP file.
struct McapTopic {
  std::string name;
  std::string type;
  std::string schema_encoding;   ///< "ros2msg", "jsonschema"
  std::string definition;        ///< in that encoding
  std::string message_encoding;  ///< "cdr", "json"
};

/// Compression of the chunks of a file that is written.
enum class McapPacking { none, zstd };

/// Writes an MCAP file with chunks, their index, statistics and a summary, for programs with random access.
/// It appears under its name at finish() only.
class McapFile {
 public:
  explicit McapFile(const std::string& path, McapPacking packing = McapPacking::zstd);

  /// Returns the number of the channel, for message().
  std::uint16_t add_topic(const McapTopic& topic);
  void message(std::uint16_t channel, std::uint64_t time_ns, std::string_view bytes);
  /// Writes a text under a name, after the messages so far.
  void metadata(const std::string& name, const std::string& key, const std::string& text);
  void finish();

 private:
  /// The summary of a chunk.
  struct ChunkPlace {
    std::uint64_t first_ns = 0, last_ns = 0, begin = 0, size = 0, index_size = 0, packed = 0, unpacked = 0;
    std::map<std::uint16_t, std::uint64_t> index_of;  ///< byte of the message index by channel
  };
  /// A message of the open chunk: its time, and its byte in the chunk.
  struct Entry {
    std::uint64_t time_ns = 0, at = 0;
  };

  void write(std::string_view bytes);
  void write_record(McapOp op, std::string_view content);
  void end_chunk();
  void write_index(ChunkPlace& place);
  void write_summary();

  AtomicFile file_;
  McapPacking packing_;
  std::uint64_t written_ = 0;
  std::string definitions_;  ///< schema and channel records
  ByteBuilder chunk_;
  std::map<std::uint16_t, std::vector<Entry>> entries_;  ///< of the open chunk
  std::uint64_t first_ns_ = 0, last_ns_ = 0;             ///< of the open chunk
  std::vector<ChunkPlace> chunks_;
  std::map<std::uint16_t, std::uint64_t> messages_of_;  ///< by channel
  std::uint16_t topics_ = 0;
  std::uint32_t metadata_ = 0;
  std::uint32_t sequence_ = 0;
};

}  // namespace faultline
