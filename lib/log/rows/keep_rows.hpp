// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/log/log_channels.hpp"

namespace faultline {

/// Removes all values but those of the rows `kept`, which increase; an empty channel stays empty.
inline void keep_rows(std::vector<double>& values, const std::vector<int>& kept) {
  if (values.empty()) return;
  for (std::size_t k = 0; k < kept.size(); ++k) values[k] = values[kept[k]];
  values.resize(kept.size());
}

/// The same for all channels of a log.
inline void keep_log_rows(Log& log, const std::vector<int>& kept) {
  for_each_joint_channel(log, [&](std::vector<double>& values, Channel) { keep_rows(values, kept); });
  for (ExtraChannel& extra : log.extra) keep_rows(extra.values, kept);
  keep_rows(log.time, kept);
}

}  // namespace faultline
