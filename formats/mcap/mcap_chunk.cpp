// SPDX-License-Identifier: MIT
#include "formats/mcap/mcap_chunk.hpp"

#include <algorithm>

#include "formats/bytes/byte_cursor.hpp"
#include "formats/mcap/mcap_record.hpp"

namespace faultline {
namespace {

/// The next record in the bytes of a chunk, which go on behind it; false at their end.
bool take_inside(std::string_view& inside, McapOp& op, std::string_view& content) {
  if (inside.size() < kMcapRecordHead) return false;
  ByteCursor record(inside);
  op = static_cast<McapOp>(record.take<unsigned char>());
  content = record.bytes(record.take<std::uint64_t>());
  if (!record.ok()) return false;
  inside = record.rest();
  return true;
}

std::uint64_t time_of_message(std::string_view content) {
  ByteCursor message(content);
  message.take<std::uint16_t>();
  message.take<std::uint32_t>();
  return message.take<std::uint64_t>();
}

}  // namespace

void McapChunk::begin(std::string_view inside, McapTopics& topics) {
  close();
  all_ = left_ = inside;
  bool sorted = true;
  std::uint64_t before = 0;
  std::size_t messages = 0;
  McapOp op{};
  for (std::string_view content; take_inside(inside, op, content);) {
    if (op == McapOp::schema) topics.add_schema(content);
    if (op == McapOp::channel) topics.add_channel(content);
    if (op != McapOp::message) continue;
    const std::uint64_t time = time_of_message(content);
    sorted = sorted && before <= time;
    before = time;
    ++messages;
  }
  if (!sorted) sort(messages);
}

void McapChunk::sort(std::size_t messages) {
  sorted_.reserve(messages);
  McapOp op{};
  for (std::string_view content; take_inside(left_, op, content);)
    if (op == McapOp::message)
      sorted_.push_back({time_of_message(content), static_cast<std::uint32_t>(content.data() - all_.data()),
                         static_cast<std::uint32_t>(content.size())});
  std::stable_sort(sorted_.begin(), sorted_.end(),
                   [](const Place& a, const Place& b) { return a.log_time_ns < b.log_time_ns; });
}

bool McapChunk::next(std::string_view& content) {
  if (next_sorted_ < sorted_.size()) {
    const Place& message = sorted_[next_sorted_++];
    content = all_.substr(message.begin, message.size);
    return true;
  }
  for (McapOp op{}; take_inside(left_, op, content);)
    if (op == McapOp::message) return true;
  close();
  return false;
}

void McapChunk::close() {
  all_ = left_ = {};
  sorted_ = {};
  next_sorted_ = 0;
}

}  // namespace faultline
