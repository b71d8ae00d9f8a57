// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/log/column_matching.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/log/velocity_check.hpp"

namespace faultline {

/// Estimates the time between two rows of a log without a clock from the changes of position per row,
/// compared with the velocities.
class RowClock {
 public:
  /// Uses a table that `columns` map to a joint log except for the time; any other table gives no estimate.
  RowClock(const std::vector<RawColumn>& table, ColumnMap columns, const std::string& path);
  void add(const RawBlock& block);

  struct Estimate {
    double period_s = 0.0;
    double std_s = 0.0;
  };
  /// Returns nullopt unless the moving joints agree.
  std::optional<Estimate> estimate() const;

 private:
  std::vector<double> values_of(const RawBlock& block, Channel channel) const;

  Matching matching_;
  std::vector<VelocityCheck> joints_;
  std::vector<double> rows_;
};

}  // namespace faultline
