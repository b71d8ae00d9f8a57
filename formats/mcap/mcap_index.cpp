// SPDX-License-Identifier: MIT
#include "formats/mcap/mcap_index.hpp"

#include <fmt/format.h>

#include "formats/bytes/byte_cursor.hpp"

namespace faultline {

void McapIndex::met_chunk(std::int64_t begin, std::int64_t size) { chunks_.emplace(begin, size); }

void McapIndex::check_chunk_index(std::string_view content) {
  ByteCursor record(content);
  record.take<std::uint64_t>();  // first and last time
  record.take<std::uint64_t>();
  const auto begin = static_cast<std::int64_t>(record.take<std::uint64_t>());
  const auto size = static_cast<std::int64_t>(record.take<std::uint64_t>());
  const auto chunk = chunks_.find(begin);
  ++indexed_;
  wrong_chunks_ += !record.ok() || chunk == chunks_.end() || chunk->second != size;
}

void McapIndex::check_statistics(std::string_view content) {
  ByteCursor record(content);
  const auto messages = static_cast<std::int64_t>(record.take<std::uint64_t>());
  if (record.ok()) messages_told_ = messages;
}

void McapIndex::tell(bool damaged, Issues& issues) const {
  if (damaged) return;
  if (wrong_chunks_ > 0)
    issues.add(
        {"index_wrong", "", Severity::warning,
         fmt::format("the index at the end of the file is wrong about {} of its {} chunks; the data were "
                     "read without it",
                     wrong_chunks_, indexed_)});
  if (messages_told_ >= 0 && messages_told_ != messages_)
    issues.add(
        {"index_wrong", "", Severity::warning,
         fmt::format("the statistics at the end of the file speak of {} messages, the file has {}; the "
                     "data were read without them",
                     messages_told_, messages_)});
}

}  // namespace faultline
