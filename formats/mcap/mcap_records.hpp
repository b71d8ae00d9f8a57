// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/byte_source.hpp"
#include "formats/bytes/little_endian.hpp"
#include "formats/bytes/unpack_block.hpp"
#include "formats/mcap/mcap_record.hpp"
#include "formats/messages/message_source.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// Schemas and channels of an MCAP file, in the order in which they are met.
class McapTopics {
 public:
  /// Adds the topics of the channels to `topics`, which must outlive the object.
  explicit McapTopics(TopicList& topics) : topics_(topics) {}
  /// Selects the recording of the file, from 0, whose numbers follow; each recording has its own.
  void start_recording(std::size_t recording) {
    recording_ = recording;
    if (recordings_.size() <= recording) recordings_.resize(recording + 1);
  }
  /// Adds the content of a schema record; damaged and repeated ones are ignored.
  void add_schema(std::string_view content) {
    ByteCursor record(content);
    const auto id = record.take<std::uint16_t>();
    const std::string_view name = record.text(), language = record.text(), definition = record.text();
    const bool is_ros = record.ok() && (language == "ros2msg" || language == "ros1msg");
    if (record.ok())
      numbers().schemas.emplace(id, Schema{std::string(name.substr(0, kLongestTopicText)),
                                           std::string(is_ros ? definition : std::string_view())});
  }

  /// Does the same for a channel record.
  void add_channel(std::string_view content) {
    ByteCursor record(content);
    const auto id = record.take<std::uint16_t>(), schema = record.take<std::uint16_t>();
    const std::string_view name = record.text(), encoding = record.text();
    if (!record.ok() || numbers().topic_of_channel.count(id)) return;
    const auto known = numbers().schemas.find(schema);
    const Schema stated = known == numbers().schemas.end() ? Schema{} : known->second;
    numbers().topic_of_channel.emplace(
        id, topics_.add({std::string(name), stated.type, std::string(encoding), stated.definition}));
  }

  /// Returns the topic of a channel id; -1 for an unknown one.
  int topic_of(std::uint16_t channel) const {
    const auto found = numbers().topic_of_channel.find(channel);
    return found == numbers().topic_of_channel.end() ? -1 : found->second;
  }

 private:
  struct Schema {
    std::string type, definition;
  };
  /// Types and topics of one recording, by their numbers.
  struct Numbers {
    std::map<std::uint16_t, Schema> schemas;
    std::map<std::uint16_t, int> topic_of_channel;
  };
  const Numbers& numbers() const { return recordings_[recording_]; }
  Numbers& numbers() { return recordings_[recording_]; }

  std::vector<Numbers> recordings_ = std::vector<Numbers>(1);
  std::size_t recording_ = 0;
  TopicList& topics_;
};

/// The records at the top level of an MCAP file in their order. After damage they continue at the next record
/// that can be found.
class McapRecords {
 public:
  /// All must outlive the object.
  McapRecords(ByteWindow& bytes, const McapTopics& topics, Issues& issues)
      : bytes_(bytes), topics_(topics), issues_(issues) {}

  /// Begins at the front of the bytes.
  void start() {
    record_size_ = 0;
    last_time_ = 0;
    cut_ = too_large_ = finished_ = damaged_ = behind_footer_ = false;
    recordings_ = 0;
    recording_begin_ = 0;
  }

  /// Moves to the next record; false at the end of the file or of its data.
  bool next() {
    bytes_.skip(record_size_);
    record_size_ = 0;
    while (!finished_) {
      const int marks = pass_marks();
      if (behind_footer_)
        end_recording(marks);
      else if (marks > 0 && bytes_.fill(1))
        begin_recording();
      if (finished_) break;
      if (!bytes_.fill(kMcapRecordHead)) {
        end();
        break;
      }
      if (take_record()) return true;
      if (!find_record()) end();
    }
    return false;
  }

  McapOp op() const { return op_; }
  /// Valid until the next call; shorter than the record if the file ends in it.
  std::string_view content() const { return bytes_.view().substr(kMcapRecordHead, size_); }
  /// Size of the content as stated in the record; more than content() may hold.
  std::uint64_t size() const { return record_size_ - kMcapRecordHead; }
  /// True when the file ends in this record, which is then a chunk.
  bool is_cut() const { return cut_; }
  /// True when the record is too large to be read at once; content() then has only its beginning.
  bool is_too_large() const { return too_large_; }
  /// Number of recordings that begin before this record: one, unless files were concatenated.
  std::size_t recordings() const { return recordings_; }
  /// Byte of the file at which the recording begins.
  std::int64_t recording_begin() const { return recording_begin_; }
  /// Byte of the file at which the record begins.
  std::int64_t begin() const { return bytes_.position(); }
  bool damaged() const { return damaged_; }
  /// Sets the time of the last message, which helps to recognise a message after damage.
  void met_time(std::uint64_t log_time_ns) { last_time_ = log_time_ns; }

 private:
  /// Largest content in bytes that is read; larger records are skipped.
  static constexpr std::uint64_t kLargestContent = kLargestBlock;
  /// Bytes of a message before its data.
  static constexpr std::uint64_t kMessageHead = 22;
  static constexpr std::uint64_t kFooterSize = 20, kDataEndSize = 4;
  /// After damage a message is accepted only if it is less than this later than the last one.
  static constexpr std::uint64_t kLikelyStep_ns = 86'400'000'000'000;
  static constexpr std::size_t kSearchedAtOnce = 1 << 16;

  /// True when `content`, the beginning of a chunk's content of this size, has a valid chunk header.
  static bool is_chunk(std::string_view content, std::uint64_t size) {
    ByteCursor chunk(content);
    const auto first = chunk.take<std::uint64_t>(), last = chunk.take<std::uint64_t>();
    chunk.take<std::uint64_t>();
    chunk.take<std::uint32_t>();
    const std::string_view packing = chunk.text();
    const auto records = chunk.take<std::uint64_t>();
    return chunk.ok() && first <= last && (packing.empty() || packing == "lz4" || packing == "zstd") &&
           records == size - chunk.position();
  }

  /// True when a record that find_record() can recognise is at the front of `bytes`.
  bool is_record(std::string_view bytes) const {
    if (bytes.starts_with(kMcapMagic)) return true;  // another recording follows
    ByteCursor head(bytes);
    const auto op = static_cast<McapOp>(head.take<unsigned char>());
    const auto size = head.take<std::uint64_t>();
    if (!head.ok() || size > bytes_.left()) return false;
    if (op == McapOp::chunk) return is_chunk(head.rest(), size);
    if (op == McapOp::data_end) return size == kDataEndSize;
    if (op == McapOp::footer)
      return size == kFooterSize && head.rest()
                                        .substr(std::min<std::size_t>(kFooterSize, head.rest().size()))
                                        .starts_with(kMcapMagic);
    if (op != McapOp::message || size < kMessageHead) return false;
    const int topic = topics_.topic_of(head.take<std::uint16_t>());
    head.take<std::uint32_t>();
    const auto time = head.take<std::uint64_t>();
    return head.ok() && topic >= 0 && time >= last_time_ && time - last_time_ < kLikelyStep_ns;
  }

  /// Moves past damaged bytes to the next record; false when there is none.
  bool find_record() {
    const std::int64_t begin = bytes_.position();
    bool found = false;
    do {
      bytes_.advance(std::min<std::size_t>(1, bytes_.view().size()));
      bytes_.fill(kSearchedAtOnce);
      const std::string_view view = bytes_.view();
      // The last bytes are searched again together with those that follow them.
      const std::size_t reach =
          view.size() < kSearchedAtOnce ? view.size() : view.size() - kSearchedAtOnce / 2;
      std::size_t at = 0;
      while (at < reach && !(found = is_record(view.substr(at)))) ++at;
      bytes_.advance(at);
    } while (!found && !bytes_.view().empty());
    damaged_ = true;
    issues_.add(
        {"records_damaged", "", Severity::severe,
         fmt::format("bytes {} to {} are not records; their data are lost", begin, bytes_.position())});
    return found;
  }

  void end() {
    finished_ = true;
    damaged_ = true;
    issues_.add({"file_truncated", "", Severity::severe,
                 fmt::format("the file ends without its end mark, at byte {}; the recording is cut",
                             bytes_.position() + static_cast<std::int64_t>(bytes_.view().size()))});
  }

  /// Skips the marks at this position and returns their number; a recording begins and ends with one.
  int pass_marks() {
    int marks = 0;
    for (; bytes_.fill(kMcapMagic.size()) && bytes_.view().starts_with(kMcapMagic); ++marks) {
      mark_at_ = bytes_.position();
      bytes_.advance(kMcapMagic.size());
    }
    return marks;
  }

  void begin_recording() {
    behind_footer_ = false;
    recording_begin_ = mark_at_;
    last_time_ = 0;
    if (++recordings_ == 1) return;
    issues_.add(
        {"recordings_joined", "", Severity::warning,
         fmt::format("another recording begins at byte {}, as if files were joined by cat; it is read as "
                     "part of the log",
                     recording_begin_)});
  }

  /// Handles the end of a recording: after the footer the mark is repeated, and another recording may follow.
  void end_recording(int marks) {
    const bool more = bytes_.fill(kMcapRecordHead);
    const bool header_follows = more && static_cast<McapOp>(bytes_.view()[0]) == McapOp::header;
    if (marks > 1 || (marks == 1 && header_follows)) return begin_recording();
    finished_ = true;
    const auto left_over = static_cast<std::int64_t>(bytes_.view().size());
    if (marks == 0) {
      damaged_ = true;
      issues_.add({"file_truncated", "", Severity::warning,
                   "the last bytes of the file are missing or damaged; they hold no data"});
    } else if (left_over > 0) {
      issues_.add({"trailing_bytes", "", Severity::warning,
                   fmt::format("the bytes from {} on, after the end of the recording, were ignored",
                               bytes_.position())});
    }
  }

  /// True when a record that is too large to be read at once has a plausible beginning.
  bool is_likely(McapOp op, std::uint64_t size) {
    constexpr std::size_t kHeadOfAChunk = 64;
    bytes_.fill(kMcapRecordHead + kHeadOfAChunk);
    const std::string_view content = bytes_.view().substr(kMcapRecordHead);
    if (op == McapOp::chunk) return is_chunk(content, size);
    ByteCursor message(content);
    return op == McapOp::attachment ||
           (op == McapOp::message && topics_.topic_of(message.take<std::uint16_t>()) >= 0);
  }

  /// Takes the record at this position; false when there is none.
  bool take_record() {
    ByteCursor head(bytes_.view());
    const auto op = head.take<unsigned char>();
    const auto size = head.take<std::uint64_t>();
    op_ = static_cast<McapOp>(op);
    too_large_ = is_mcap_op(op) && size > kLargestContent && size <= bytes_.left() && is_likely(op_, size);
    const bool whole = is_mcap_op(op) && size <= kLargestContent && bytes_.fill(kMcapRecordHead + size);
    // A chunk in which the file ends still holds the messages before the end.
    cut_ = !whole && is_mcap_op(op) && size <= kLargestContent && size > bytes_.left() &&
           op_ == McapOp::chunk && is_chunk(bytes_.view().substr(kMcapRecordHead), size);
    if (!whole && !cut_ && !too_large_) return false;
    size_ = std::min<std::size_t>(size, bytes_.view().size() - kMcapRecordHead);
    record_size_ = kMcapRecordHead + (too_large_ ? size : size_);
    behind_footer_ = op_ == McapOp::footer;
    return true;
  }

  ByteWindow& bytes_;
  const McapTopics& topics_;
  Issues& issues_;
  McapOp op_{};
  std::size_t size_ = 0;           ///< of the content in view
  std::uint64_t record_size_ = 0;  ///< with its head; skipped at the next call
  std::uint64_t last_time_ = 0;
  bool cut_ = false, too_large_ = false, finished_ = false, damaged_ = false;
  bool behind_footer_ = false;
  std::size_t recordings_ = 0;
  std::int64_t recording_begin_ = 0, mark_at_ = 0;
};

}  // namespace faultline
