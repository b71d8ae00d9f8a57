// SPDX-License-Identifier: MIT
#include "formats/mcap/mcap_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "formats/bytes/byte_cursor.hpp"
#include "formats/bytes/unpack_block.hpp"

namespace faultline {
namespace {

/// Content that is looked at; larger records, such as attachments, are passed over.
constexpr std::uint64_t kLargestContent = kLargestBlock;
/// Of a message, before its data.
constexpr std::uint64_t kMessageHead = 22;
constexpr std::uint64_t kFooterSize = 20, kDataEndSize = 4;
/// Behind damage a message is believed that is not later than this after the last one.
constexpr std::uint64_t kLikelyStep_ns = 86'400'000'000'000;
constexpr std::size_t kSearchedAtOnce = 1 << 16;

/// Whether the content of a chunk, of which some is in view, can be one of this size.
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

void McapRecords::start(std::int64_t file_size) {
  file_size_ = file_size;
  record_size_ = kMcapMagic.size();
  last_time_ = 0;
  cut_ = finished_ = damaged_ = false;
}

std::uint64_t McapRecords::left() const {
  if (file_size_ <= 0) return std::numeric_limits<std::uint64_t>::max();
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, file_size_ - bytes_.position()));
}

/// Whether a record that would be found by search stands at the front of `bytes`.
bool McapRecords::is_record(std::string_view bytes) const {
  ByteCursor head(bytes);
  const auto op = static_cast<McapOp>(head.take<unsigned char>());
  const auto size = head.take<std::uint64_t>();
  if (!head.ok() || size > left()) return false;
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

/// Goes on behind damaged bytes.
bool McapRecords::find_record() {
  const std::int64_t begin = bytes_.position();
  bool found = false;
  do {
    bytes_.advance(std::min<std::size_t>(1, bytes_.view().size()));
    bytes_.fill(kSearchedAtOnce);
    const std::string_view view = bytes_.view();
    // The last bytes are looked at again with what follows them.
    const std::size_t reach = view.size() < kSearchedAtOnce ? view.size() : view.size() - kSearchedAtOnce / 2;
    std::size_t at = 0;
    while (at < reach && !(found = is_record(view.substr(at)))) ++at;
    bytes_.advance(at);
  } while (!found && !bytes_.view().empty());
  damaged_ = true;
  issues_.add(
      {"records_damaged", "", Severity::severe,
       fmt::format("bytes {} to {} are no records; what they held is lost", begin, bytes_.position())});
  return found;
}

void McapRecords::skip(std::uint64_t size) {
  while (size > 0 && bytes_.fill(1)) {
    const std::size_t now = std::min<std::uint64_t>(size, bytes_.view().size());
    bytes_.advance(now);
    size -= now;
  }
}

void McapRecords::end() {
  finished_ = true;
  damaged_ = true;
  issues_.add(
      {"file_truncated", "", Severity::severe,
       fmt::format("the file ends without its end mark, at byte {}; the recording was cut or its end lost",
                   bytes_.position() + static_cast<std::int64_t>(bytes_.view().size()))});
}

/// At the footer, behind which the mark of the beginning stands once more.
void McapRecords::finish_whole() {
  bytes_.fill(record_size_ + kMcapMagic.size());
  finished_ = true;
  if (bytes_.view().substr(record_size_).starts_with(kMcapMagic)) return;
  damaged_ = true;
  issues_.add({"file_truncated", "", Severity::warning,
               "the last bytes of the file are missing or damaged; they hold no data"});
}

bool McapRecords::next() {
  skip(record_size_);
  record_size_ = 0;
  while (!finished_) {
    if (!bytes_.fill(kMcapRecordHead)) {
      end();
      break;
    }
    ByteCursor head(bytes_.view());
    const auto op = head.take<unsigned char>();
    const auto size = head.take<std::uint64_t>();
    const bool passed_over = size > kLargestContent && size <= left() && is_mcap_op(op);
    if (passed_over && static_cast<McapOp>(op) == McapOp::attachment) {
      skip(kMcapRecordHead + size);
      continue;
    }
    const bool whole = is_mcap_op(op) && size <= kLargestContent && bytes_.fill(kMcapRecordHead + size);
    // A chunk or message that the file ends in still holds what came before.
    cut_ = !whole && is_mcap_op(op) && size <= kLargestContent && size > left() &&
           static_cast<McapOp>(op) == McapOp::chunk && is_chunk(head.rest(), size);
    if (!whole && !cut_) {
      if (!find_record()) end();
      continue;
    }
    op_ = static_cast<McapOp>(op);
    size_ = std::min<std::size_t>(size, bytes_.view().size() - kMcapRecordHead);
    record_size_ = kMcapRecordHead + size_;
    if (op_ == McapOp::footer) finish_whole();
    return true;
  }
  return false;
}

}  // namespace faultline
