// SPDX-License-Identifier: MIT
#pragma once

#include "lib/log/recorder/measured_row.hpp"

namespace faultline {

/// State of a recorder at a row.
enum class RecorderState {
  runs,       ///< this row, and the undecided ones before, were measured
  undecided,  ///< the row repeats the one before; later rows decide
  froze,      ///< this row, and the undecided ones before, repeat a row in which joints moved
  blank,      ///< the whole row is zero, and the joints were not at zero
};

/// Finds rows in which the recorder stood still while the robot moved: position, velocity and torque of every
/// joint keep all digits although the velocity is not zero, or all become zero from one row to the next. Not
/// found are: a stuck encoder of a single joint, as other columns change; a robot at rest, as its velocity is
/// zero and agrees with the motion until then; and rows that a faster logger repeats for a moment.
class StoppedRecorder {
 public:
  RecorderState take(const MeasuredRow& row);

 private:
  RecorderState repeated(const MeasuredRow& row);
  bool becomes_blank(const MeasuredRow& row) const;
  /// Whether the velocities of the repeated row move the joints noticeably within this time.
  bool moves_within(double seconds) const;

  MeasuredRow last_;           ///< the row before
  double since_ = 0.0;         ///< time of the repeated row
  int repeats_ = 0;            ///< rows since then
  double usual_hold_s_ = 0.0;  ///< longest repetition after which the joints moved
  RecorderState state_ = RecorderState::runs;
};

}  // namespace faultline
