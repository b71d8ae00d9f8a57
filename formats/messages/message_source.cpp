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

}  // namespace faultline
