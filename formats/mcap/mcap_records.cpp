// SPDX-License-Identifier: MIT
#include "formats/mcap/mcap_records.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "formats/bytes/little_endian.hpp"
#include "formats/bytes/unpack_block.hpp"

namespace faultline {
namespace {

/// Largest content in bytes that is read; larger records are skipped.
constexpr std::uint64_t kLargestContent = kLargestBlock;
/// Bytes of a message before its data.
constexpr std::uint64_t kMessageHead = 22;
constexpr std::uint64_t kFooterSize = 20, kDataEndSize = 4;
/// After damage a message is accepted only if it is less than this later than the last one.
constexpr std::uint64_t kLikelyStep_ns = 86'400'000'000'000;
constexpr std::size_t kSearchedAtOnce = 1 << 16;

/// True when `content`, the beginning of a chunk's content of this size, has a valid chunk header.
bool is_chunk(std::string_view content, std::uint64_t size) {
  ByteCursor chunk(content);
  const auto first = chunk.take<std::uint64_t>(), last = chunk.take<std::uint64_t>();
  chunk.take<std::uint64_t>();
  chunk.take<std::uint32_t>();
  const std::string_view packing = chunk.text();
  const auto records = chunk.take<std::uint64_t>();
  return chunk.ok() && first <= last && (packing.empty() || packing == "lz4" || packing == "zstd") &&
         records == size - chunk.position();
}

}  // namespace

void McapTopics::start_recording(std::size_t recording) {
  recording_ = recording;
  if (recordings_.size() <= recording) recordings_.resize(recording + 1);
}

void McapTopics::add_schema(std::string_view content) {
  ByteCursor record(content);
  const auto id = record.take<std::uint16_t>();
  const std::string_view name = record.text();
  if (record.ok()) numbers().type_of_schema.emplace(id, name.substr(0, kLongestTopicText));
}

void McapTopics::add_channel(std::string_view content) {
  ByteCursor record(content);
  const auto id = record.take<std::uint16_t>(), schema = record.take<std::uint16_t>();
  const std::string_view name = record.text(), encoding = record.text();
  if (!record.ok() || numbers().topic_of_channel.count(id)) return;
  const auto type = numbers().type_of_schema.find(schema);
  const bool known = type != numbers().type_of_schema.end();
  numbers().topic_of_channel.emplace(
      id, topics_.add({std::string(name), known ? type->second : "", std::string(encoding)}));
}

int McapTopics::topic_of(std::uint16_t channel) const {
  const auto found = numbers().topic_of_channel.find(channel);
  return found == numbers().topic_of_channel.end() ? -1 : found->second;
}

void McapRecords::start() {
  record_size_ = 0;
  last_time_ = 0;
  cut_ = too_large_ = finished_ = damaged_ = behind_footer_ = false;
  recordings_ = 0;
  recording_begin_ = 0;
}

/// True when a record that find_record() can recognise is at the front of `bytes`.
bool McapRecords::is_record(std::string_view bytes) const {
  if (bytes.starts_with(kMcapMagic)) return true;  // another recording follows
  ByteCursor head(bytes);
  const auto op = static_cast<McapOp>(head.take<unsigned char>());
  const auto size = head.take<std::uint64_t>();
  if (!head.ok() || size > bytes_.left()) return false;
  if (op == McapOp::chunk) return is_chunk(head.rest(), size);
  if (op == McapOp::data_end) return size == kDataEndSize;
  if (op == McapOp::footer)
    return size == kFooterSize &&
           head.rest().substr(std::min<std::size_t>(kFooterSize, head.rest().size())).starts_with(kMcapMagic);
  if (op != McapOp::message || size < kMessageHead) return false;
  const int topic = topics_.topic_of(head.take<std::uint16_t>());
  head.take<std::uint32_t>();
  const auto time = head.take<std::uint64_t>();
  return head.ok() && topic >= 0 && time >= last_time_ && time - last_time_ < kLikelyStep_ns;
}

/// Moves past damaged bytes to the next record; false when there is none.
bool McapRecords::find_record() {
  const std::int64_t begin = bytes_.position();
  bool found = false;
  do {
    bytes_.advance(std::min<std::size_t>(1, bytes_.view().size()));
    bytes_.fill(kSearchedAtOnce);
    const std::string_view view = bytes_.view();
    // The last bytes are searched again together with those that follow them.
    const std::size_t reach = view.size() < kSearchedAtOnce ? view.size() : view.size() - kSearchedAtOnce / 2;
    std::size_t at = 0;
    while (at < reach && !(found = is_record(view.substr(at)))) ++at;
    bytes_.advance(at);
  } while (!found && !bytes_.view().empty());
  damaged_ = true;
  issues_.add({"records_damaged", "", Severity::severe,
               fmt::format("bytes {} to {} are not records; their data are lost", begin, bytes_.position())});
  return found;
}

void McapRecords::end() {
  finished_ = true;
  damaged_ = true;
  issues_.add({"file_truncated", "", Severity::severe,
               fmt::format("the file ends without its end mark, at byte {}; the recording is cut",
                           bytes_.position() + static_cast<std::int64_t>(bytes_.view().size()))});
}

/// Skips the marks at this position and returns their number; a recording begins and ends with one.
int McapRecords::pass_marks() {
  int marks = 0;
  for (; bytes_.fill(kMcapMagic.size()) && bytes_.view().starts_with(kMcapMagic); ++marks) {
    mark_at_ = bytes_.position();
    bytes_.advance(kMcapMagic.size());
  }
  return marks;
}

void McapRecords::begin_recording() {
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
void McapRecords::end_recording(int marks) {
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
bool McapRecords::is_likely(McapOp op, std::uint64_t size) {
  constexpr std::size_t kHeadOfAChunk = 64;
  bytes_.fill(kMcapRecordHead + kHeadOfAChunk);
  const std::string_view content = bytes_.view().substr(kMcapRecordHead);
  if (op == McapOp::chunk) return is_chunk(content, size);
  ByteCursor message(content);
  return op == McapOp::attachment ||
         (op == McapOp::message && topics_.topic_of(message.take<std::uint16_t>()) >= 0);
}

/// Takes the record at this position; false when there is none.
bool McapRecords::take_record() {
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

bool McapRecords::next() {
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

}  // namespace faultline
