// SPDX-License-Identifier: MIT
#include "formats/messages/lost_messages.hpp"

namespace faultline {

void LostMessages::begin_chunk() {
  met_.clear();
  lossy_ = false;
}

void LostMessages::told(std::uint32_t channel, std::size_t messages, int topic) {
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
