// SPDX-License-Identifier: MIT
#include "lib/log/rows/sparse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/log/log_channels.hpp"
#include "lib/log/rows/keep_rows.hpp"

namespace faultline {
namespace {

void hold(std::vector<double>& values, double& held) {
  for (double& value : values) {
    if (std::isnan(value))
      value = held;
    else
      held = value;
  }
}

std::vector<int> rows_with_position(const Log& log) {
  std::vector<int> rows;
  for (int i = 0; i < log.rows(); ++i)
    if (std::any_of(log.q.begin(), log.q.end(), [&](const auto& joint) { return !std::isnan(joint[i]); }))
      rows.push_back(i);
  return rows;
}

}  // namespace

void SparseRows::gather(Log& segment, Issues& issues) {
  const std::vector<int> rows = rows_with_position(segment);
  const auto lost = static_cast<std::int64_t>(segment.rows()) - std::ssize(rows);
  std::vector<std::vector<double>*> channels;
  for_each_joint_channel(segment, [&](std::vector<double>& values, Channel) { channels.push_back(&values); });
  for (ExtraChannel& extra : segment.extra) channels.push_back(&extra.values);
  held_.resize(channels.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    hold(*channels[c], held_[c]);
    keep_rows(*channels[c], rows);
  }
  keep_rows(segment.time, rows);
  if (lost > 0)
    issues.add(
        {"row_of_other_signals", "", Severity::note,
         "rows without a position were left out; what they hold of other signals stays until the next value",
         0, std::numeric_limits<double>::quiet_NaN(), lost, lost});
}

}  // namespace faultline
