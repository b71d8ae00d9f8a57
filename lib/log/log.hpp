// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

}  // namespace faultline
