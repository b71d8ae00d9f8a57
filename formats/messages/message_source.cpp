// SPDX-License-Identifier: MIT
#include "formats/messages/message_source.hpp"

#include <fmt/format.h>

#include "formats/bytes/little_endian.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostTopics = 1 << 17;
constexpr std::size_t kMostTopicBytes = 1 << 24;         ///< of the texts of all topics
constexpr std::size_t kLongestTypeDefinition = 1 << 18;  ///< bytes; a longer one counts as not stated

constexpr std::size_t kNamedTopics = 20;  ///< that a sentence lists

}  // namespace

std::string topics_sentence(const std::vector<Topic>& topics) {
  if (topics.empty()) return "it holds no topics";
  std::string text = "its topics are ";
  for (std::size_t i = 0; i < topics.size() && i < kNamedTopics; ++i)
    text += fmt::format("{}{} ({}, {})", i ? ", " : "", in_quotes(topics[i].name),
                        shortened(topics[i].type, kLongestName), shortened(topics[i].encoding, kLongestName));
  if (topics.size() > kNamedTopics) text += fmt::format(" and {} more", topics.size() - kNamedTopics);
  return text;
}

int TopicList::add(Topic topic) {
  for (std::string* text : {&topic.name, &topic.type, &topic.encoding})
    if (text->size() > kLongestTopicText) text->resize(kLongestTopicText);
  const auto next = static_cast<int>(topics_.size());
  const auto [place, fresh] = index_of_.emplace(std::tuple(topic.name, topic.type, topic.encoding), next);
  if (!fresh) return place->second;
  if (topic.definition.size() > kLongestTypeDefinition) topic.definition.clear();
  bytes_ += topic.name.size() + topic.type.size() + topic.encoding.size() + topic.definition.size();
  if (topics_.size() == kMostTopics || bytes_ > kMostTopicBytes)
    throw Error(ErrorCode::input, path_,
                fmt::format("names more than {} topics, or topics with more than {} MiB of names; write a "
                            "recording with only the topic of the joint states",
                            kMostTopics, kMostTopicBytes >> 20));
  topics_.push_back(std::move(topic));
  return next;
}

bool ChunkedSource::next(Message& message) {
  while (!at_end_) {
    if (!missing_.empty()) {
      message = {missing_.front(), 0, {}, true};
      missing_.pop_front();
      return true;
    }
    Taken taken = next_inside(message);
    if (taken == Taken::nothing) taken = next_record(message);
    if (taken == Taken::message) return true;
    at_end_ = taken == Taken::nothing;
    if (!at_end_) continue;
    bytes_->read_to_end();
    check_end();
    issues_.merge(bytes_->issues());
  }
  return false;
}

void ChunkedSource::rewind() {
  bytes_->rewind();
  window_.clear();
  issues_ = {};
  begin_chunk();
  missing_.clear();
  at_end_ = false;
  start();
}

ChunkedSource::Taken ChunkedSource::give(const Message& found, const char* what, std::uint32_t channel,
                                         Message& message) {
  bytes_->spend(kMessageWork_ns);
  ++given_[channel];
  message = found;
  if (found.topic >= 0) return Taken::message;
  issues_.add({"channel_unknown", "", Severity::warning,
               fmt::format("skipped a message of {} {}: the file does not declare its topic and type", what,
                           channel)});
  return Taken::other;
}

void ChunkedSource::begin_chunk() {
  given_.clear();
  lossy_ = doubtful_ = false;
}

void ChunkedSource::lose_chunk(const std::string& why, bool doubtful) {
  lossy_ = true;
  doubtful_ = doubtful;
  issues_.add({"chunk_damaged", "", Severity::severe,
               fmt::format("the chunk at byte {}: {}{}", window_.position(), why,
                           doubtful ? "; its messages were left out" : "")});
}

void ChunkedSource::unpack(BlockPacking packing, std::uint64_t size, std::uint32_t checksum, bool is_cut,
                           std::string_view& bytes) {
  bool sound = bytes.size() == size;
  if (packing != BlockPacking::none) {
    sound = unpack_block(packing, bytes, size, unpacked_);
    bytes = unpacked_.view();
    bytes_->spend(block_work_ns(packing, static_cast<std::int64_t>(bytes.size())));
  }
  if (is_cut)
    lose_chunk("the file ends inside it; the data before the cut are read", false);
  else if (!sound)
    lose_chunk("it cannot be unpacked to its end", true);
  else if (checksum != 0 && crc32_of(bytes) != checksum)
    lose_chunk("its checksum does not match", true);
}

void ChunkedSource::compare(std::uint32_t channel, std::size_t messages, int topic) {
  if (!lossy_ || topic < 0) return;
  for (std::size_t& given = given_[channel]; given < messages; ++given) missing_.push_back(topic);
}

}  // namespace faultline
