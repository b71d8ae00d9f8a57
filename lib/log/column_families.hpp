// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/log/channel_names.hpp"

namespace faultline {

/// Columns whose names differ by a number only, one for each joint.
struct ColumnFamily {
  Quantity quantity = Quantity::q;
  int fitness = 0;
  int as_torque = 0;
  std::map<int, int> column_of;  ///< by the number in the name; 1 when it has none
  bool numbered = false;

  int columns() const { return static_cast<int>(column_of.size()); }
  /// Joints up to the first that has no column, where the first of all has the number `first`.
  int joints(int first) const {
    int joints = 0;
    while (column_of.count(first + joints)) ++joints;
    return joints;
  }
  /// The number of the first joint, 0 or 1. A family that lacks some of `joints` joints counts as that of the
  /// positions does, which have their first at `usual`, as far as its numbers allow.
  int first(int usual = 1, int joints = 0) const {
    if (column_of.begin()->first == 0) return 0;
    const bool lacks_some = columns() < joints && column_of.rbegin()->first < joints;
    return usual == 0 && lacks_some ? 0 : 1;
  }
};

/// The families of the columns that `is_free` leaves, in the order of the file.
std::vector<ColumnFamily> column_families(const std::vector<std::string>& names,
                                          const std::function<bool(int)>& is_free);

using IsUsable = std::function<bool(const ColumnFamily&)>;

/// The usable family that fits a quantity best: canonical names first, then numbered ones, then the better
/// fit, then more columns, then file order; null for none.
const ColumnFamily* best_family(const std::vector<ColumnFamily>& families, Quantity quantity,
                                const IsUsable& usable);

/// The family that fits best as the torque of a log: by its canonical name, else commanded before measured.
const ColumnFamily* best_torque(const std::vector<ColumnFamily>& families, const IsUsable& usable);

/// Columns of seconds and nanoseconds, as ROS writes a stamp.
struct TimePair {
  int seconds = -1;
  int nanoseconds = -1;
};
std::optional<TimePair> find_time_pair(const std::vector<std::string>& names);

}  // namespace faultline
