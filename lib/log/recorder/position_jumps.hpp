// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "lib/log/recorder/measured_row.hpp"

namespace faultline {

/// Detects position changes from row to row that far exceed what the velocities at both rows allow. A log
/// without velocities has no jumps.
class PositionJumps {
 public:
  /// Returns the joints, from 0, that jump between the row before and this one, at this usual step of time.
  const std::vector<int>& take(const MeasuredRow& row, double usual_step_s);
  /// After take(): the two joints that continue as each other from this row on, if any.
  std::optional<std::pair<int, int>> swapped() const;

 private:
  /// Returns how far, beyond what velocities allow, joint `to` now is from joint `from` before, in rad or m.
  double excess(int from, int to) const;
  bool jumps(int from, int to) const;
  void learn(int joint);

  MeasuredRow last_, now_;
  double shortest_s_ = 0.0, longest_s_ = 0.0;
  std::vector<double> usual_;  ///< mean distance from the position that the velocities predict, by joint
  std::vector<int> learned_;   ///< rows in that mean, up to kEnoughOfJumps
  std::vector<int> jumped_;
};

}  // namespace faultline
