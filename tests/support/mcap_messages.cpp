// SPDX-License-Identifier: MIT
#include "tests/support/mcap_messages.hpp"

#include <zstd.h>

#include <cstring>

#include "lib/core/atomic_file.hpp"

namespace faultline {
namespace {

class Bytes {
 public:
  explicit Bytes(const std::string& bytes) : bytes_(bytes) {}

  template <typename T>
  T number() {
    T value{};
    std::memcpy(&value, bytes_.substr(at_, sizeof value).data(), sizeof value);
    at_ += sizeof value;
    return value;
  }
  std::string take(std::uint64_t size) {
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  std::string text() { return take(number<std::uint32_t>()); }
  std::string rest() { return take(bytes_.size() - at_); }
  bool ended() const { return at_ >= bytes_.size(); }
  void align(std::size_t size, std::size_t start) { at_ += (size - (at_ - start) % size) % size; }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

enum Op : unsigned char { kChannel = 4, kMessage = 5, kChunk = 6, kMetadata = 12, kDataEnd = 15 };

void take_records(Bytes bytes, std::map<std::uint16_t, std::string>& topics, RecordedFile& file);

std::string unpacked_chunk(Bytes chunk) {
  chunk.take(2 * sizeof(std::uint64_t));
  const auto size = chunk.number<std::uint64_t>();
  chunk.number<std::uint32_t>();
  const std::string packing = chunk.text();
  const std::string inside = chunk.take(chunk.number<std::uint64_t>());
  if (packing.empty()) return inside;
  std::string out(size, '\0');
  out.resize(ZSTD_decompress(out.data(), out.size(), inside.data(), inside.size()));
  return out;
}

void take_channel(Bytes record, std::map<std::uint16_t, std::string>& topics, RecordedFile& file) {
  const auto id = record.number<std::uint16_t>();
  record.number<std::uint16_t>();
  topics[id] = record.text();
  file.encoding[topics[id]] = record.text();
}

void take_message(Bytes record, const std::map<std::uint16_t, std::string>& topics, RecordedFile& file) {
  const std::string& topic = topics.at(record.number<std::uint16_t>());
  record.number<std::uint32_t>();
  const auto time = record.number<std::uint64_t>();
  record.number<std::uint64_t>();
  file.messages[topic].push_back({time, record.rest()});
}

void take_metadata(Bytes record, RecordedFile& file) {
  const std::string name = record.text();
  Bytes map(record.text());
  map.text();
  file.metadata[name] = map.text();
}

void take_records(Bytes bytes, std::map<std::uint16_t, std::string>& topics, RecordedFile& file) {
  while (!bytes.ended()) {
    const auto op = bytes.number<unsigned char>();
    const Bytes record(bytes.take(bytes.number<std::uint64_t>()));
    if (op == kDataEnd) return;
    if (op == kChannel) take_channel(record, topics, file);
    if (op == kMessage) take_message(record, topics, file);
    if (op == kMetadata) take_metadata(record, file);
    if (op == kChunk) take_records(Bytes(unpacked_chunk(record)), topics, file);
  }
}

}  // namespace

RecordedFile read_mcap(const std::string& path) {
  constexpr std::size_t kMagicBytes = 8;
  Bytes bytes(read_file(path).substr(kMagicBytes));
  RecordedFile file;
  std::map<std::uint16_t, std::string> topics;
  take_records(bytes, topics, file);
  return file;
}

std::vector<std::vector<double>> joint_state_arrays(const std::string& message) {
  constexpr std::size_t kHead = 4, kStamp = 8, kWord = 4;  // encapsulation; where alignment counts from
  Bytes bytes(message);
  bytes.take(kHead + kStamp);
  bytes.text();
  bytes.align(kWord, kHead);
  for (auto names = bytes.number<std::uint32_t>(); names > 0; --names) {
    bytes.text();
    bytes.align(kWord, kHead);
  }
  std::vector<std::vector<double>> arrays(3);
  for (std::vector<double>& array : arrays) {
    bytes.align(kWord, kHead);
    array.resize(bytes.number<std::uint32_t>());
    if (!array.empty()) bytes.align(sizeof(double), kHead);
    for (double& value : array) value = bytes.number<double>();
  }
  return arrays;
}

}  // namespace faultline
