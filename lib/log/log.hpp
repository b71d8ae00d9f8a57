// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/log/channel_names.hpp"

namespace faultline {

/// One quantity of every joint: [joint][row], joints from base to tip. Empty if the log does not have it.
using JointSignals = std::vector<std::vector<double>>;

/// A recorded quantity without a canonical meaning, kept under its own name.
struct ExtraChannel {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

/// A segment of a joint log in SI units (rad or m, rad/s or m/s, N m or N), columns of equal length. A
/// missing value is NaN. Segments of one log follow each other without overlap.
struct Log {
  std::int64_t first_row = 0;  ///< rows of the log before this segment
  std::vector<double> time;    ///< s
  JointSignals q;              ///< position; always present
  JointSignals dq;             ///< velocity
  JointSignals tau;            ///< torque or force; its meaning (commanded, measured) is in the robot file
  JointSignals q_ref;          ///< commanded position
  JointSignals dq_ref;         ///< commanded velocity
  JointSignals tau_ref;        ///< commanded torque or force, beside `tau`
  JointSignals tau_meas;       ///< measured torque or force, beside `tau`
  std::vector<ExtraChannel> extra;

  int rows() const { return static_cast<int>(time.size()); }
  int joints() const { return static_cast<int>(q.size()); }
};

/// Gives `log` the channels of `like` with `rows` rows, reusing its storage.
void resize_like(Log& log, const Log& like, int rows);
/// Returns rows [begin, end) as a log of their own.
Log slice(const Log& log, int begin, int end);
/// Appends the rows of `more`, which has the same channels (or `log` is empty).
void append(Log& log, const Log& more);
/// The same; an empty `log` gets the storage of `more`.
void append(Log& log, Log&& more);
/// Removes the first rows of `log` and returns them, without a copy if that is all of them.
Log take_front(Log& log, int rows);

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
