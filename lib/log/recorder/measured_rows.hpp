// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// The values of all joints at one time: positions, then velocities, then torques, as far as the log has
/// them.
struct MeasuredRow {
  double t = 0.0;
  std::vector<double> values;
  int joints = 0;
  bool has_velocity = false;
  bool has_torque = false;

  double q(int j) const { return values[j]; }
  double dq(int j) const { return has_velocity ? values[joints + j] : std::nan(""); }

  /// Copies row `row` of a segment, reusing the storage.
  void take(const Log& log, int row) {
    t = log.time[row];
    joints = log.joints();
    has_velocity = !log.dq.empty();
    has_torque = !log.tau.empty();
    values.clear();
    for (const JointSignals* signals : {&log.q, &log.dq, &log.tau})
      for (const std::vector<double>& joint : *signals) values.push_back(joint[row]);
  }
};

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

/// Detects position changes from row to row that far exceed what the velocities at both rows allow. A log
/// without velocities has no jumps.
class PositionJumps {
 public:
  /// Returns the joints that jump between the row before and this one, at this usual step of time.
  const std::vector<Joint>& take(const MeasuredRow& row, double usual_step_s);
  /// After take(): the two joints that continue as each other from this row on, if any.
  std::optional<std::pair<Joint, Joint>> swapped() const;

 private:
  /// Returns how far, beyond what velocities allow, joint `to` now is from joint `from` before, in rad or m.
  double excess(int from, int to) const;
  bool jumps(int from, int to) const;
  void learn(int j);

  MeasuredRow last_, now_;
  double shortest_s_ = 0.0, longest_s_ = 0.0;
  std::vector<double> usual_;  ///< mean distance from the position that the velocities predict, by joint
  std::vector<int> learned_;   ///< rows in that mean, up to kEnoughOfJumps
  std::vector<Joint> jumped_;
};

/// Stores the latest rows by a hash of all their digits, to find repeated rows.
class RowMemory {
 public:
  /// Adds a row with its index. Returns find(row) among the rows before.
  std::int64_t add(const MeasuredRow& row, std::int64_t index);
  /// Returns the index of the latest row with the same digits; -1 for none among about kRows rows.
  std::int64_t find(const MeasuredRow& row) const;

  static constexpr std::size_t kRows = 1 << 16;  // a minute at 1 kHz; 1 MiB

 private:
  struct Entry {
    std::uint64_t hash = 0;
    std::int64_t index = -1;
  };
  std::vector<Entry> entries_;  ///< empty, or kRows of them
};

}  // namespace faultline
