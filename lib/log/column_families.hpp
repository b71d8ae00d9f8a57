// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/log/channel_names.hpp"

namespace faultline {

/// Columns whose names differ by a number only, one for each joint.
struct ColumnFamily {
  Quantity quantity = Quantity::q;
  int fitness = 0;
  int as_torque = 0;
  std::map<int, int> column_of;  ///< column by the number in its name; 1 if the name has no number
  bool numbered = false;

  int columns() const { return static_cast<int>(column_of.size()); }
  /// Returns the number of joints, numbered from `first`, before the first one that has no column.
  int joints(int first) const {
    int joints = 0;
    while (column_of.count(first + joints)) ++joints;
    return joints;
  }
  /// Returns the number of the first joint, 0 or 1. A family that lacks a column for some of `joints` joints
  /// is numbered like the positions, whose first number is `usual`, if its own numbers allow that.
  int first(int usual = 1, int joints = 0) const {
    if (column_of.begin()->first == 0) return 0;
    const bool lacks_some = columns() < joints && column_of.rbegin()->first < joints;
    return usual == 0 && lacks_some ? 0 : 1;
  }
};

/// Returns the families of the columns for which `is_free` is true, in the order of the file.
std::vector<ColumnFamily> column_families(const std::vector<std::string>& names,
                                          const std::function<bool(int)>& is_free);

using IsUsable = std::function<bool(const ColumnFamily&)>;

/// Returns the usable family that fits a quantity best: canonical names first, then numbered ones, then the
/// better fit, then more columns, then file order; null for none.
const ColumnFamily* best_family(const std::vector<ColumnFamily>& families, Quantity quantity,
                                const IsUsable& usable);

/// The same for the torque of a log, as which a commanded torque fits better than a measured one.
const ColumnFamily* best_torque(const std::vector<ColumnFamily>& families, const IsUsable& usable);

/// Columns of seconds and nanoseconds, as in a ROS stamp.
struct TimePair {
  int seconds = -1;
  int nanoseconds = -1;
};
std::optional<TimePair> find_time_pair(const std::vector<std::string>& names);

/// Returns channels and column indices of joints that the columns name by words, not numbers, such as
/// "shoulder_pos", "elbow_pos" and "elbow_torque": joints in the order of their positions in the file, other
/// quantities by the same words. Empty unless at least two positions have words of their own, so that
/// "raw_pos" beside "pos" stays one joint.
std::vector<std::pair<Channel, int>> named_joints(const std::vector<std::string>& names,
                                                  const std::function<bool(int)>& is_free);

}  // namespace faultline
