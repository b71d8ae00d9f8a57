// SPDX-License-Identifier: MIT
#include "formats/channel_list.hpp"

#include "lib/log/log_channels.hpp"

namespace faultline {

std::vector<WrittenChannel> channels_of(const Log& log) {
  std::vector<WrittenChannel> channels{{"t", "", &log.time}};
  for_each_joint_channel(log, [&](const std::vector<double>& values, Channel channel) {
    channels.push_back({to_string(channel), "", &values});
  });
  for (const ExtraChannel& extra : log.extra)
    channels.push_back(
        {(canonical_channel(extra.name) ? "other_" : "") + extra.name, extra.unit, &extra.values});
  return channels;
}

}  // namespace faultline
