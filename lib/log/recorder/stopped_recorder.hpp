// SPDX-License-Identifier: MIT
#pragma once

#include "lib/log/recorder/measured_row.hpp"

namespace faultline {

/// What a row is to a recorder that may have stood still.
enum class RecorderState {
  runs,       ///< this row, and those that waited, were measured
  undecided,  ///< the row repeats the one before; it waits for later rows
  froze,      ///< this row, and those that waited, repeat a row in which the joints moved
  blank,      ///< all of the row is zero, where the joints were not
};

/// Finds rows in which the recorder stood still while the robot went on: every joint's position, velocity and
/// torque at once keep all their digits although the velocity says that the joints move, or all become zero
/// from one row to the next. A single joint's encoder that is stuck is not that: other columns go on. A robot
/// at rest is not that either: its velocity is zero, and it comes to rest on a way that the velocity allows.
/// Rows that a faster logger repeats for a moment are measured ones.
class StoppedRecorder {
 public:
  RecorderState take(const MeasuredRow& row);

 private:
  RecorderState repeated(const MeasuredRow& row);
  bool becomes_blank(const MeasuredRow& row) const;
  /// Whether the velocities of the repeated row move the joints within this time.
  bool moves_within(double seconds) const;

  MeasuredRow last_;           ///< the row before
  double since_ = 0.0;         ///< time of the row that is repeated
  int repeats_ = 0;            ///< rows since then
  double usual_hold_s_ = 0.0;  ///< longest repetition after which the joints moved on
  RecorderState state_ = RecorderState::runs;
};

}  // namespace faultline
