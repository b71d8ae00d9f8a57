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

  int first() const { return column_of.begin()->first == 0 ? 0 : 1; }
  int joints() const {
    int joints = 0;
    while (column_of.count(first() + joints)) ++joints;
    return joints;
  }
};

/// The families of the columns that `is_free` leaves, in the order of the file.
std::vector<ColumnFamily> column_families(const std::vector<std::string>& names,
                                          const std::function<bool(int)>& is_free);

/// The family that fits a quantity best: canonical names first, then numbered ones, then the better fit, then
/// more joints, then file order; null for none.
const ColumnFamily* best_family(const std::vector<ColumnFamily>& families, Quantity quantity);

/// The family that fits best as the torque of a log: by its canonical name, else commanded before measured.
const ColumnFamily* best_torque(const std::vector<ColumnFamily>& families);

/// Columns of seconds and nanoseconds, as ROS writes a stamp.
struct TimePair {
  int seconds = -1;
  int nanoseconds = -1;
};
std::optional<TimePair> find_time_pair(const std::vector<std::string>& names);

}  // namespace faultline
