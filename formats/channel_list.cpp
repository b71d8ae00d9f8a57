// SPDX-License-Identifier: MIT
#include "formats/channel_list.hpp"

#include "lib/log/channel_names.hpp"

namespace faultline {

std::vector<WrittenChannel> channels_of(const Log& log) {
  std::vector<WrittenChannel> channels{{"t", "", &log.time}};
  auto add = [&](const JointSignals& signals, Quantity quantity) {
    for (std::size_t j = 0; j < signals.size(); ++j)
      channels.push_back({to_string({quantity, static_cast<int>(j) + 1}), "", &signals[j]});
  };
  add(log.q, Quantity::q);
  add(log.dq, Quantity::dq);
  add(log.tau, Quantity::tau);
  add(log.q_ref, Quantity::q_ref);
  add(log.dq_ref, Quantity::dq_ref);
  for (const ExtraChannel& extra : log.extra)
    channels.push_back(
        {(canonical_channel(extra.name) ? "other_" : "") + extra.name, extra.unit, &extra.values});
  return channels;
}

}  // namespace faultline
