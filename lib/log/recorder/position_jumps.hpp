// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "lib/log/recorder/measured_row.hpp"

namespace faultline {

/// Watches from row to row whether positions change by far more than the velocities at both rows allow. A log
/// without velocities has no jumps.
class PositionJumps {
 public:
  /// The joints that jump between the row before and this one, from 0. `usual_step_s`: time between two rows.
  const std::vector<int>& take(const MeasuredRow& row, double usual_step_s);
  /// After take(): the two joints that go on as each other from this row on, if there are such.
  std::optional<std::pair<int, int>> swapped() const;

 private:
  /// How far joint `from` before and joint `to` now are beyond what their velocities allow.
  double excess(int from, int to) const;
  bool jumps(int from, int to) const;
  void learn(int joint);

  MeasuredRow last_, now_;
  double shortest_s_ = 0.0, longest_s_ = 0.0;
  std::vector<double> usual_;  ///< mean distance from the way that the velocities give, by joint
  std::vector<int> learned_;   ///< rows in it, up to enough
  std::vector<int> jumped_;
};

}  // namespace faultline
