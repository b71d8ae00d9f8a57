// SPDX-License-Identifier: MIT
#include "formats/messages/message_source.hpp"

#include <algorithm>

namespace faultline {

int add_topic(std::vector<Topic>& topics, const Topic& topic) {
  const auto found = std::find(topics.begin(), topics.end(), topic);
  if (found != topics.end()) return static_cast<int>(found - topics.begin());
  topics.push_back(topic);
  return static_cast<int>(topics.size()) - 1;
}

}  // namespace faultline
