// SPDX-License-Identifier: MIT
#include "lib/log/rows/sparse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/log/log_channels.hpp"

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

void keep(std::vector<double>& values, const std::vector<int>& rows) {
  if (values.empty()) return;
  for (std::size_t k = 0; k < rows.size(); ++k) values[k] = values[rows[k]];
  values.resize(rows.size());
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
    keep(*channels[c], rows);
  }
  keep(segment.time, rows);
  if (lost > 0)
    issues.add(
        {"row_of_other_signals", "", Severity::note,
         "rows without a position were left out; what they hold of other signals stays until the next value",
         0, std::numeric_limits<double>::quiet_NaN(), lost, lost});
}

}  // namespace faultline
