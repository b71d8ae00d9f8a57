// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/byte_source.hpp"
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
  void start_recording(std::size_t recording);
  /// Adds the content of a schema or channel record; damaged and repeated ones are ignored.
  void add_schema(std::string_view content);
  void add_channel(std::string_view content);
  /// Returns the topic of a channel id; -1 for an unknown one.
  int topic_of(std::uint16_t channel) const;

 private:
  /// Types and topics of one recording, by their numbers.
  struct Numbers {
    std::map<std::uint16_t, std::string> type_of_schema;
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
  void start();
  /// Moves to the next record; false at the end of the file or of its data.
  bool next();
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
  bool is_record(std::string_view bytes) const;
  bool find_record();
  void end();
  int pass_marks();
  void begin_recording();
  void end_recording(int marks);
  bool is_likely(McapOp op, std::uint64_t size);
  bool take_record();

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
