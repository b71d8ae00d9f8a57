// SPDX-License-Identifier: MIT
#pragma once

#include <zstd.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/bytes/little_endian.hpp"
#include "formats/mcap/mcap_record.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"

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
  explicit McapFile(const std::string& path, McapPacking packing = McapPacking::zstd)
      : file_(path), packing_(packing) {
    write(kMcapMagic);
    write_record(McapOp::header, ByteBuilder().put_text("ros2").put_text("faultline").bytes());
  }

  /// Returns the number of the channel, for message().
  std::uint16_t add_topic(const McapTopic& topic) {
    const std::uint16_t id = ++topics_;
    ByteBuilder schema, channel, both;
    schema.put(id).put_text(topic.type).put_text(topic.schema_encoding).put_text(topic.definition);
    channel.put(id).put(id).put_text(topic.name).put_text(topic.message_encoding).put_text("");
    put_record(both, McapOp::schema, schema.bytes());
    put_record(both, McapOp::channel, channel.bytes());
    definitions_ += both.bytes();
    chunk_.put_bytes(both.bytes());
    return id;
  }

  void message(std::uint16_t channel, std::uint64_t time_ns, std::string_view bytes) {
    first_ns_ = entries_.empty() ? time_ns : std::min(first_ns_, time_ns);
    last_ns_ = entries_.empty() ? time_ns : std::max(last_ns_, time_ns);
    entries_[channel].push_back({time_ns, chunk_.bytes().size()});
    ++messages_of_[channel];
    const std::uint64_t size = sizeof channel + sizeof sequence_ + 2 * kTime + bytes.size();
    chunk_.put(static_cast<unsigned char>(McapOp::message)).put(size);
    chunk_.put(channel).put(sequence_++).put(time_ns).put(time_ns).put_bytes(bytes);
    if (chunk_.bytes().size() >= kChunkBytes) end_chunk();
  }

  /// Writes a text under a name, after the messages so far.
  void metadata(const std::string& name, const std::string& key, const std::string& text) {
    end_chunk();
    ByteBuilder map, content;
    map.put_text(key).put_text(text);
    content.put_text(name).put_text(map.bytes());
    write_record(McapOp::metadata, content.bytes());
    ++metadata_;
  }

  void finish() {
    end_chunk();
    write_record(McapOp::data_end, ByteBuilder().put(std::uint32_t{0}).bytes());
    write_summary();
    write(kMcapMagic);
    file_.commit();
  }

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

  static constexpr std::size_t kChunkBytes = 1 << 20;
  static constexpr int kZstdLevel = 1;
  static constexpr std::size_t kIndexEntry = 16;
  static constexpr std::size_t kTime = 8, kCount = 8;  ///< bytes of a number in a map

  static const char* name_of(McapPacking packing) { return packing == McapPacking::zstd ? "zstd" : ""; }

  static std::string packed(std::string_view bytes, McapPacking packing) {
    if (packing == McapPacking::none) return std::string(bytes);
    std::string out(ZSTD_compressBound(bytes.size()), '\0');
    const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kZstdLevel);
    if (ZSTD_isError(size)) throw Error(ErrorCode::internal, "zstd", ZSTD_getErrorName(size));
    out.resize(size);
    return out;
  }

  static void put_record(ByteBuilder& out, McapOp op, std::string_view content) {
    out.put(static_cast<unsigned char>(op))
        .put(static_cast<std::uint64_t>(content.size()))
        .put_bytes(content);
  }

  /// Writes a map from channels to numbers of 64 bits.
  static void put_map(ByteBuilder& out, const std::map<std::uint16_t, std::uint64_t>& values) {
    out.put(static_cast<std::uint32_t>(values.size() * (sizeof(std::uint16_t) + kCount)));
    for (const auto& [channel, value] : values) out.put(channel).put(value);
  }

  void write(std::string_view bytes) {
    file_.write(bytes);
    written_ += bytes.size();
  }

  void write_record(McapOp op, std::string_view content) {
    ByteBuilder record;
    put_record(record, op, content);
    write(record.bytes());
  }

  void end_chunk() {
    const std::string& inside = chunk_.bytes();
    if (inside.empty()) return;
    const std::string small = packed(inside, packing_);
    ByteBuilder content;
    content.put(first_ns_).put(last_ns_).put(static_cast<std::uint64_t>(inside.size())).put(crc32_of(inside));
    content.put_text(name_of(packing_)).put(static_cast<std::uint64_t>(small.size())).put_bytes(small);
    ChunkPlace place{first_ns_, last_ns_,     written_,      kMcapRecordHead + content.bytes().size(),
                     0,         small.size(), inside.size(), {}};
    write_record(McapOp::chunk, content.bytes());
    write_index(place);
    chunks_.push_back(place);
    entries_.clear();
    chunk_.clear();
  }

  void write_index(ChunkPlace& place) {
    const std::uint64_t begin = written_;
    for (const auto& [channel, entries] : entries_) {
      place.index_of[channel] = written_;
      ByteBuilder content;
      content.put(channel).put(static_cast<std::uint32_t>(kIndexEntry * entries.size()));
      for (const Entry& entry : entries) content.put(entry.time_ns).put(entry.at);
      write_record(McapOp::message_index, content.bytes());
    }
    place.index_size = written_ - begin;
  }

  void write_summary() {
    ByteBuilder summary, statistics;
    std::uint64_t messages = 0, first = 0, last = 0;
    for (const auto& [channel, count] : messages_of_) messages += count;
    for (const ChunkPlace& chunk : chunks_) {
      first = &chunk == &chunks_.front() ? chunk.first_ns : std::min(first, chunk.first_ns);
      last = std::max(last, chunk.last_ns);
    }
    statistics.put(messages).put(topics_).put(static_cast<std::uint32_t>(topics_));
    statistics.put(std::uint32_t{0}).put(metadata_).put(static_cast<std::uint32_t>(chunks_.size()));
    statistics.put(first).put(last);
    put_map(statistics, messages_of_);
    summary.put_bytes(definitions_);
    put_record(summary, McapOp::statistics, statistics.bytes());
    for (const ChunkPlace& chunk : chunks_) {
      ByteBuilder index;
      index.put(chunk.first_ns).put(chunk.last_ns).put(chunk.begin).put(chunk.size);
      put_map(index, chunk.index_of);
      index.put(chunk.index_size).put_text(name_of(packing_)).put(chunk.packed).put(chunk.unpacked);
      put_record(summary, McapOp::chunk_index, index.bytes());
    }
    const std::uint64_t begin = written_;
    // The footer's checksum covers the summary and the footer up to the checksum.
    ByteBuilder footer_head;
    footer_head.put(static_cast<unsigned char>(McapOp::footer))
        .put(std::uint64_t{2 * kTime + sizeof(std::uint32_t)});
    footer_head.put(begin).put(std::uint64_t{0});
    const std::uint32_t crc = crc32_of(summary.bytes() + footer_head.bytes());
    write(summary.bytes() + footer_head.put(crc).bytes());
  }

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
