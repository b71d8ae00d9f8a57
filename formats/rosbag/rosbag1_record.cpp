// SPDX-License-Identifier: MIT
#include "formats/rosbag/rosbag1_record.hpp"

#include <algorithm>

#include "formats/bytes/byte_cursor.hpp"

namespace faultline {

std::string_view Rosbag1Fields::text(std::string_view name) const {
  ByteCursor header(header_);
  while (!header.rest().empty()) {
    const std::string_view field = header.text();
    const auto sign = field.find('=');
    if (!header.ok()) break;
    if (field.substr(0, sign) == name && sign != std::string_view::npos) return field.substr(sign + 1);
  }
  return {};
}

std::uint32_t Rosbag1Fields::word(std::string_view name) const {
  const std::string_view bytes = text(name);
  return bytes.size() == sizeof(std::uint32_t) ? ByteCursor(bytes).take<std::uint32_t>() : 0;
}

std::int64_t Rosbag1Fields::time(std::string_view name) const {
  constexpr std::int64_t kSecond = 1'000'000'000;
  ByteCursor bytes(text(name));
  const std::int64_t seconds = bytes.take<std::uint32_t>();
  return seconds * kSecond + bytes.take<std::uint32_t>();
}

Rosbag1Record rosbag1_record(std::string_view bytes) {
  ByteCursor record(bytes);
  Rosbag1Record found;
  found.fields = Rosbag1Fields(record.text());
  found.data = record.text();
  found.size = record.ok() ? record.position() : 0;
  return found;
}

std::uint64_t rosbag1_record_size(std::string_view bytes) {
  ByteCursor record(bytes);
  record.text();
  const std::uint64_t data = record.take<std::uint32_t>();
  return record.ok() ? record.position() + data : 0;
}

std::size_t rosbag1_record_before(std::string_view bytes, std::size_t at, std::uint64_t left) {
  constexpr std::size_t kFarthest = 256;
  for (std::size_t back = 2 * sizeof(std::uint32_t); back <= std::min(at, kFarthest); ++back) {
    const std::string_view candidate = bytes.substr(at - back);
    const auto header = ByteCursor(candidate).take<std::uint32_t>();
    if (header < back || header > kFarthest) continue;
    const Rosbag1Fields fields(candidate.substr(sizeof header, header));
    const std::uint64_t size = rosbag1_record_size(candidate);
    if (fields.has_op() && size > 0 && size <= left) return at - back;
  }
  return std::string_view::npos;
}

}  // namespace faultline
