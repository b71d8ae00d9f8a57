// SPDX-License-Identifier: MIT
#include "lib/log/rows/implausible.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/log/log_channels.hpp"

namespace faultline {

void blank_implausible(Log& segment, std::int64_t first_row, Issues& issues) {
  for_each_joint_channel(segment, [&](std::vector<double>& values, Channel channel) {
    bool fine = true;
    for (const double value : values) fine &= !(std::abs(value) > kImplausible);
    if (fine) return;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!(std::abs(values[i]) > kImplausible)) continue;
      const std::int64_t row = first_row + static_cast<std::int64_t>(i) + 1;
      issues.add({"value_implausible", to_string(channel), Severity::warning,
                  fmt::format("row {}: {} = {} is impossible; treated as missing", row, to_string(channel),
                              values[i]),
                  row, segment.time[i]});
      values[i] = std::nan("");
    }
  });
}

}  // namespace faultline
