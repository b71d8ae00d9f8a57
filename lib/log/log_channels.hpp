// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/joint.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// Returns the signals of a quantity of joints, that is any but the time.
JointSignals& signals_of(Log& log, Quantity quantity);
const JointSignals& signals_of(const Log& log, Quantity quantity);

/// Calls visit(values, channel) for each channel of a joint, in the order of kJointQuantities. `AnyLog` is
/// Log or const Log.
template <typename AnyLog, typename Visit>
void for_each_joint_channel(AnyLog& log, Visit visit) {
  for (const Quantity quantity : kJointQuantities) {
    auto& signals = signals_of(log, quantity);
    for (std::size_t j = 0; j < signals.size(); ++j)
      visit(signals[j], Channel{quantity, Joint::at(static_cast<int>(j))});
  }
}

/// Gives `to` the channels of `from` and calls visit(to, from) for the values of each: time, joints, extra.
template <typename Visit>
void for_each_column(Log& to, const Log& from, Visit visit) {
  visit(to.time, from.time);
  for (const Quantity quantity : kJointQuantities) {
    JointSignals& mine = signals_of(to, quantity);
    const JointSignals& theirs = signals_of(from, quantity);
    mine.resize(theirs.size());
    for (std::size_t j = 0; j < theirs.size(); ++j) visit(mine[j], theirs[j]);
  }
  to.extra.resize(from.extra.size());
  for (std::size_t i = 0; i < from.extra.size(); ++i) {
    to.extra[i].name = from.extra[i].name;
    to.extra[i].unit = from.extra[i].unit;
    visit(to.extra[i].values, from.extra[i].values);
  }
}

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
