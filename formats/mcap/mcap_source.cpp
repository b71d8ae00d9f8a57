// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/bytes/little_endian.hpp"
#include "formats/bytes/unpack_block.hpp"
#include "formats/known_formats.hpp"
#include "formats/mcap/mcap_record.hpp"
#include "formats/mcap/mcap_recording.hpp"
#include "formats/mcap/mcap_records.hpp"
#include "formats/messages/message_source.hpp"
#include "formats/provenance.hpp"
#include "lib/core/issue.hpp"

namespace faultline {
namespace {

/// Takes the next record in the bytes of a chunk and moves `inside` after it; false at their end.
bool take_inside(std::string_view& inside, McapOp& op, std::string_view& content) {
  if (inside.size() < kMcapRecordHead) return false;
  ByteCursor record(inside);
  op = static_cast<McapOp>(record.take<unsigned char>());
  content = record.bytes(record.take<std::uint64_t>());
  if (!record.ok()) return false;
  inside = record.rest();
  return true;
}

/// A message record; its data are valid as long as the record.
struct McapMessage {
  std::uint16_t channel = 0;
  std::uint64_t time_ns = 0;
  std::string_view data;
};

/// Returns nullopt for a record that is too short.
std::optional<McapMessage> mcap_message(std::string_view content) {
  ByteCursor record(content);
  McapMessage message;
  message.channel = record.take<std::uint16_t>();
  record.take<std::uint32_t>();  // its number
  message.time_ns = record.take<std::uint64_t>();
  record.take<std::uint64_t>();  // time of publication
  message.data = record.rest();
  return record.ok() ? std::optional(message) : std::nullopt;
}

/// The messages of an unpacked chunk of an MCAP file, sorted by time.
class McapChunk {
 public:
  /// Reads the definitions of the chunk, and finds its messages. `inside` must outlive the object.
  void begin(std::string_view inside, McapTopics& topics) {
    close();
    McapOp op{};
    bool sorted = true;
    for (std::string_view content; take_inside(inside, op, content);) {
      if (op == McapOp::schema) topics.add_schema(content);
      if (op == McapOp::channel) topics.add_channel(content);
      const auto message = op == McapOp::message ? mcap_message(content) : std::nullopt;
      if (!message) continue;
      sorted = sorted && (messages_.empty() || messages_.back().time_ns <= message->time_ns);
      messages_.push_back(*message);
    }
    if (!sorted)
      std::stable_sort(messages_.begin(), messages_.end(),
                       [](const McapMessage& a, const McapMessage& b) { return a.time_ns < b.time_ns; });
  }

  /// Returns the next message; null after the last.
  const McapMessage* next() { return given_ < messages_.size() ? &messages_[given_++] : nullptr; }

  void close() {
    messages_.clear();
    given_ = 0;
  }

 private:
  std::vector<McapMessage> messages_;
  std::size_t given_ = 0;  ///< messages handed out
};

/// Compares the records of an MCAP file, read from front to back, with its summary. The data are right; an
/// issue reports a summary that contradicts them.
class McapIndex {
 public:
  void met_message() { ++messages_; }
  /// Adds the chunk record at this byte; `size` includes its head.
  void met_chunk(std::int64_t begin, std::int64_t size) { chunks_.emplace(begin, size); }
  /// Content of a chunk index or statistics record of the summary.
  void check_chunk_index(std::string_view content) {
    ByteCursor record(content);
    record.take<std::uint64_t>();  // first and last time
    record.take<std::uint64_t>();
    const auto begin = static_cast<std::int64_t>(record.take<std::uint64_t>());
    const auto size = static_cast<std::int64_t>(record.take<std::uint64_t>());
    const auto chunk = chunks_.find(begin);
    ++indexed_;
    wrong_chunks_ += !record.ok() || chunk == chunks_.end() || chunk->second != size;
  }

  void check_statistics(std::string_view content) {
    ByteCursor record(content);
    const auto messages = static_cast<std::int64_t>(record.take<std::uint64_t>());
    if (record.ok()) stated_messages_ = messages;
  }

  /// Adds the errors of the summary; nothing for a damaged file.
  void report(bool damaged, Issues& issues) const {
    if (damaged) return;
    if (wrong_chunks_ > 0)
      issues.add(
          {"index_wrong", "", Severity::warning,
           fmt::format("the index at the end of the file is wrong about {} of its {} chunks; the data were "
                       "read without it",
                       wrong_chunks_, indexed_)});
    if (stated_messages_ >= 0 && stated_messages_ != messages_)
      issues.add(
          {"index_wrong", "", Severity::warning,
           fmt::format("the statistics at the end of the file count {} messages, but the file has {}; the "
                       "data were read without the statistics",
                       stated_messages_, messages_)});
  }

 private:
  std::int64_t messages_ = 0;
  std::map<std::int64_t, std::int64_t> chunks_;  ///< size by first byte
  std::int64_t indexed_ = 0, wrong_chunks_ = 0;
  std::int64_t stated_messages_ = -1;  ///< -1: no statistics
};

std::optional<BlockPacking> mcap_packing(std::string_view name) {
  if (name.empty()) return BlockPacking::none;
  if (name == "lz4") return BlockPacking::lz4_frame;
  if (name == "zstd") return BlockPacking::zstd;
  return std::nullopt;
}

class McapSource : public ChunkedSource {
 public:
  explicit McapSource(std::unique_ptr<ByteSource> bytes)
      : ChunkedSource(std::move(bytes), "mcap"), channels_(topics_), records_(window_, channels_, issues_) {
    start();
  }

 private:
  void start() override {
    index_ = {};
    chunk_.close();
    records_.start();
  }

  Taken next_inside(Message& message) override {
    const McapMessage* found = chunk_.next();
    return found ? give_message(*found, is_doubtful(), message) : Taken::nothing;
  }

  Taken next_record(Message& message) override {
    if (!records_.next()) return Taken::nothing;
    const std::string_view content = records_.content();
    switch (records_.op()) {
      case McapOp::header:
        begin_recording();
        break;
      case McapOp::schema:
        channels_.add_schema(content);
        break;
      case McapOp::channel:
        channels_.add_channel(content);
        break;
      case McapOp::message:
        if (const auto found = mcap_message(content))
          return give_message(*found, records_.is_too_large(), message);
        break;
      case McapOp::chunk:
        open_chunk(content);
        break;
      case McapOp::message_index:
        count_lost(content);
        break;
      case McapOp::chunk_index:
        index_.check_chunk_index(content);
        break;
      case McapOp::metadata:
        read_provenance(content);
        break;
      case McapOp::statistics:
        index_.check_statistics(content);
        break;
      default:
        break;
    }
    return Taken::other;
  }

  void begin_recording() {
    if (records_.recordings() > 1) check_end();
    index_ = {};
    channels_.start_recording(std::max<std::size_t>(records_.recordings(), 1) - 1);
  }

  void read_provenance(std::string_view content) {
    ByteCursor record(content);
    if (record.text() != kMcapProvenance) return;
    ByteCursor map(record.text());
    const bool is_ours = map.text() == kMcapProvenanceKey;
    const std::string_view text = map.text();
    issues_.add(issue_from_provenance(is_ours && map.ok() && record.ok() ? text : ""));
  }

  Taken give_message(const McapMessage& found, bool lost, Message& message) {
    index_.met_message();
    const int topic = channels_.topic_of(found.channel);
    if (topic >= 0) records_.met_time(found.time_ns);
    return give({topic, static_cast<std::int64_t>(found.time_ns), found.data, lost}, "channel", found.channel,
                message);
  }

  void open_chunk(std::string_view content) {
    ByteCursor chunk(content);
    chunk.take<std::uint64_t>();
    chunk.take<std::uint64_t>();
    const auto size = chunk.take<std::uint64_t>();
    const auto checksum = chunk.take<std::uint32_t>();
    const auto packing = mcap_packing(chunk.text());
    chunk.take<std::uint64_t>();
    chunk_.close();
    begin_chunk();
    if (!chunk.ok() || !packing)
      return lose_chunk("its header is damaged or names an unknown compression", true);
    if (records_.is_too_large() || size > kLargestBlock)
      return lose_chunk(too_large_block(std::max<std::uint64_t>(size, records_.size())), true);
    index_.met_chunk(records_.begin() - records_.recording_begin(),
                     static_cast<std::int64_t>(kMcapRecordHead + content.size()));
    std::string_view inside = chunk.rest();
    unpack(*packing, size, checksum, records_.is_cut(), inside);
    chunk_.begin(inside, channels_);
  }

  /// Counts the messages of a damaged chunk from the index after it.
  void count_lost(std::string_view content) {
    ByteCursor record(content);
    const auto channel = record.take<std::uint16_t>();
    constexpr std::size_t kEntry = 16;
    const std::size_t messages = record.text().size() / kEntry;
    if (record.ok()) compare(channel, messages, channels_.topic_of(channel));
  }

  void check_end() override { index_.report(records_.damaged() || issues_.find("chunk_damaged"), issues_); }

  McapTopics channels_;
  McapRecords records_;
  McapIndex index_;
  McapChunk chunk_;  ///< the open one
};

}  // namespace

bool looks_like_mcap(std::string_view head) { return head.starts_with(kMcapMagic); }

std::unique_ptr<RawReader> open_mcap(std::unique_ptr<ByteSource> bytes) {
  return read_joint_states(std::make_unique<McapSource>(std::move(bytes)));
}

}  // namespace faultline
