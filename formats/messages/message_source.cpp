// SPDX-License-Identifier: MIT
#include "formats/messages/message_source.hpp"

#include <fmt/format.h>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostTopics = 1 << 17;
constexpr std::size_t kMostTopicBytes = 1 << 24;  ///< of the texts of all topics

}  // namespace

int TopicList::add(Topic topic) {
  for (std::string* text : {&topic.name, &topic.type, &topic.encoding})
    if (text->size() > kLongestTopicText) text->resize(kLongestTopicText);
  const auto next = static_cast<int>(topics_.size());
  const auto [place, fresh] = index_of_.emplace(std::tuple(topic.name, topic.type, topic.encoding), next);
  if (!fresh) return place->second;
  bytes_ += topic.name.size() + topic.type.size() + topic.encoding.size();
  if (topics_.size() == kMostTopics || bytes_ > kMostTopicBytes)
    throw Error(ErrorCode::input, path_,
                fmt::format("names more than {} topics, or topics with more than {} MiB of names; write a "
                            "recording with only the topic of the joint states",
                            kMostTopics, kMostTopicBytes >> 20));
  topics_.push_back(std::move(topic));
  return next;
}

void LostMessages::begin_chunk() {
  met_.clear();
  lossy_ = false;
}

void LostMessages::compare(std::uint32_t channel, std::size_t messages, int topic) {
  if (!lossy_ || topic < 0) return;
  for (std::size_t& met = met_[channel]; met < messages; ++met) topics_.push_back(topic);
}

bool LostMessages::next(Message& message) {
  if (given_ == topics_.size()) {
    topics_.clear();
    given_ = 0;
    return false;
  }
  message = {topics_[given_++], 0, {}, true};
  return true;
}

}  // namespace faultline
