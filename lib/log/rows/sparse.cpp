// SPDX-License-Identifier: MIT
#include "lib/log/rows/sparse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/log/log_channels.hpp"
#include "lib/log/rows/keep_rows.hpp"
#include "lib/log/runs/judged_moment.hpp"

namespace faultline {
namespace {

constexpr int kHeldRows = 10;  // at least

/// Fills gaps with the latest value. A joint's signal without values for longer than a moment has ended: its
/// last value is no longer a measurement.
void hold(std::vector<double>& values, const std::vector<double>& time, bool is_measured,
          SparseRows::Held& held) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) {
      held = {values[i], time[i], 0};
    } else if (!is_measured || ++held.rows <= kHeldRows || time[i] - held.since_s <= judged_moment_s(0.0)) {
      values[i] = held.value;
    }
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
  const std::size_t joint_channels = channels.size();
  for (ExtraChannel& extra : segment.extra) channels.push_back(&extra.values);
  held_.resize(channels.size());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    hold(*channels[c], segment.time, c < joint_channels, held_[c]);
    keep_rows(*channels[c], rows);
  }
  keep_rows(segment.time, rows);
  if (lost > 0)
    issues.add({"row_of_other_signals", "", Severity::note,
                "rows without a position were left out; the values of other signals in them hold until the "
                "next value, or for a moment",
                0, std::numeric_limits<double>::quiet_NaN(), lost, lost});
}

}  // namespace faultline
