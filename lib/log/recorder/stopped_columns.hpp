// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lib/log/log.hpp"

namespace faultline {

/// The columns of a log that a recorder reads together.
enum class ColumnGroup { positions, velocities, torques };
inline constexpr int kColumnGroups = 3;

/// A group of which every joint keeps all digits from one row to the next.
struct ColumnHold {
  std::int64_t first_row = 0;  ///< from 0: the one that the others repeat
  std::int64_t repeats = 0;    ///< rows after it
  bool is_zero = false;        ///< all of its values are exactly zero
  bool stopped = false;        ///< the other columns contradict it: these rows were not measured
  bool decided = false;        ///< stays as it is until the hold ends
};

/// Finds groups of columns in which the recorder stood still, or wrote zeros, while the others went on: the
/// positions and velocities of two joints or more do not belong together while one of the groups keeps every
/// digit, or velocities change while all torques keep every digit, which they did not do before. A robot at
/// rest, or at constant speed, contradicts nothing; a single joint's sensor may be faulty and is none of
/// this.
class StoppedColumns {
 public:
  /// The next row, which has this number from 0. Gives what is known of each group with it.
  const std::array<ColumnHold, kColumnGroups>& take(const Log& rows, int at, std::int64_t number);

 private:
  struct Follow {
    std::vector<double> last;   ///< values of the row before
    double since_s = 0.0;       ///< time of the hold's first row
    double usual_s = 0.0;       ///< longest short hold: of a source that is read more often than it measures
    std::int64_t changes = 0;   ///< rows that differ from the one before
    std::vector<double> apart;  ///< of each joint: change of the position less that of its velocity
    std::vector<double> low, high;  ///< of each joint's velocity
  };

  void begin(int group, const Log& rows, int at, std::int64_t number);
  void go_on(int group, const Log& rows, int at);
  bool is_contradicted(int group, int joints) const;
  bool is_long(int group, double time_s) const;

  std::array<ColumnHold, kColumnGroups> holds_;
  std::array<Follow, kColumnGroups> follow_;
  std::vector<double> q_, dq_;  ///< of the row before
  double t_ = 0.0;
};

}  // namespace faultline
