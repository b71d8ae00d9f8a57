// SPDX-License-Identifier: MIT
#include "formats/mcap/mcap_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "formats/bytes/byte_cursor.hpp"
#include "formats/bytes/unpack_block.hpp"
#include "formats/mcap/mcap_chunk.hpp"
#include "formats/mcap/mcap_index.hpp"
#include "formats/mcap/mcap_records.hpp"
#include "formats/mcap/mcap_writer.hpp"
#include "formats/messages/joint_state_reader.hpp"
#include "formats/messages/lost_messages.hpp"
#include "formats/provenance.hpp"

namespace faultline {
namespace {

std::optional<BlockPacking> mcap_packing(std::string_view name) {
  if (name.empty()) return BlockPacking::none;
  if (name == "lz4") return BlockPacking::lz4_frame;
  if (name == "zstd") return BlockPacking::zstd;
  return std::nullopt;
}

class McapSource : public MessageSource {
 public:
  explicit McapSource(std::unique_ptr<ByteSource> bytes)
      : bytes_(std::move(bytes)),
        window_(*bytes_),
        topics_(bytes_->path()),
        records_(window_, topics_, issues_) {
    records_.start(size_if_known());
  }

  const std::string& path() const override { return bytes_->path(); }
  const char* format() const override { return "mcap"; }
  const std::vector<Topic>& topics() const override { return topics_.all(); }
  const Issues& issues() const override { return issues_; }
  const std::string& sha256() const override { return bytes_->sha256(); }
  double share_read() const override { return bytes_->share_read(); }
  void spend(std::int64_t work_ns) override { bytes_->spend(work_ns); }

  bool next(Message& message) override {
    while (!at_end_) {
      if (lost_.next(message)) return true;
      if (std::string_view content; chunk_.next(content)) {
        if (read_message(content, chunk_doubtful_, message)) return true;
      } else if (!next_record(message)) {
        end();
      } else if (given_) {
        given_ = false;
        return true;
      }
    }
    return false;
  }

  void rewind() override {
    bytes_->rewind();
    window_.clear();
    issues_ = {};
    index_ = {};
    chunk_.close();
    lost_ = {};
    given_ = at_end_ = false;
    records_.start(size_if_known());
  }

 private:
  std::int64_t size_if_known() const { return bytes_->compression() ? 0 : bytes_->file_size(); }

  /// Takes the next record; `given_` when it is a message. False at the end.
  bool next_record(Message& message) {
    if (!records_.next()) return false;
    const std::string_view content = records_.content();
    switch (records_.op()) {
      case McapOp::header:
        begin_recording();
        break;
      case McapOp::schema:
        topics_.add_schema(content);
        break;
      case McapOp::channel:
        topics_.add_channel(content);
        break;
      case McapOp::message:
        given_ = read_message(content, records_.is_too_large(), message);
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
    return true;
  }

  void begin_recording() {
    if (records_.recordings() > 1) index_.tell(records_.damaged() || issues_.find("chunk_damaged"), issues_);
    index_ = {};
    topics_.start_recording(std::max<std::size_t>(records_.recordings(), 1) - 1);
  }

  void read_provenance(std::string_view content) {
    ByteCursor record(content);
    if (record.text() != kMcapProvenance) return;
    ByteCursor map(record.text());
    const bool is_ours = map.text() == kMcapProvenanceKey;
    const std::string_view text = map.text();
    issues_.add(issue_from_provenance(is_ours && map.ok() && record.ok() ? text : ""));
  }

  bool read_message(std::string_view content, bool lost, Message& message) {
    ByteCursor record(content);
    const auto channel = record.take<std::uint16_t>();
    record.take<std::uint32_t>();
    const auto log_time = record.take<std::uint64_t>();
    record.take<std::uint64_t>();
    if (!record.ok()) return false;
    bytes_->spend(kMessageWork_ns);
    index_.met_message();
    lost_.met(channel);
    message = {topics_.topic_of(channel), static_cast<std::int64_t>(log_time), record.rest(), lost};
    if (message.topic >= 0) {
      records_.met_time(log_time);
      return true;
    }
    issues_.add(
        {"channel_unknown", "", Severity::warning,
         fmt::format("a message of channel {} was left out, as the file does not tell what it is", channel)});
    return false;
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
    lost_.begin_chunk();
    chunk_doubtful_ = false;
    if (!chunk.ok() || !packing) return lose_chunk("its head cannot be read");
    if (records_.is_too_large() || size > kLargestBlock)
      return lose_chunk(too_large_block(std::max<std::uint64_t>(size, records_.size())));
    index_.met_chunk(records_.begin() - records_.recording_begin(),
                     static_cast<std::int64_t>(kMcapRecordHead + content.size()));
    std::string_view inside = chunk.rest();
    bool sound = inside.size() == size;
    if (*packing != BlockPacking::none) {
      sound = unpack_block(*packing, inside, size, unpacked_);
      inside = unpacked_.view();
      bytes_->spend(block_work_ns(*packing, static_cast<std::int64_t>(inside.size())));
    }
    const bool wrong = sound && checksum != 0 && mcap_crc(inside) != checksum;
    if (records_.is_cut())
      lose_chunk("the file ends in it; what stands before is read", false);
    else if (!sound || wrong)
      lose_chunk(wrong ? "its checksum does not match" : "it cannot be unpacked to its end");
    chunk_.begin(inside, topics_);
  }

  void lose_chunk(const std::string& why, bool doubtful = true) {
    chunk_doubtful_ = doubtful;
    lost_.lose();
    issues_.add({"chunk_damaged", "", Severity::severe,
                 fmt::format("the chunk at byte {}: {}{}", records_.begin(), why,
                             doubtful ? "; its messages were left out" : "")});
  }

  /// The index behind a damaged chunk tells how many messages it had.
  void count_lost(std::string_view content) {
    ByteCursor record(content);
    const auto channel = record.take<std::uint16_t>();
    constexpr std::size_t kEntry = 16;
    const std::size_t messages = record.text().size() / kEntry;
    if (record.ok()) lost_.told(channel, messages, topics_.topic_of(channel));
  }

  void end() {
    at_end_ = true;
    bytes_->read_to_end();
    index_.tell(records_.damaged() || issues_.find("chunk_damaged"), issues_);
    issues_.merge(bytes_->issues());
  }

  std::unique_ptr<ByteSource> bytes_;
  ByteWindow window_;
  McapTopics topics_;
  Issues issues_;
  McapRecords records_;
  McapIndex index_;
  BlockBytes unpacked_;          ///< the open chunk, where it was compressed
  McapChunk chunk_;              ///< the open one
  bool chunk_doubtful_ = false;  ///< its bytes may be wrong
  LostMessages lost_;
  bool given_ = false, at_end_ = false;
};

}  // namespace

bool looks_like_mcap(std::string_view head) { return head.starts_with(kMcapMagic); }

std::unique_ptr<RawReader> open_mcap(std::unique_ptr<ByteSource> bytes) {
  return read_joint_states(std::make_unique<McapSource>(std::move(bytes)));
}

}  // namespace faultline
