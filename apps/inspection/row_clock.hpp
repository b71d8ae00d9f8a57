// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/log/column_matching.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/log/velocity_check.hpp"

namespace faultline {

/// The time between two rows of a log without a clock, from how far the positions of its joints change from
/// row to row for their velocities.
class RowClock {
 public:
  /// Of a table that is no joint log with `columns` for want of a time; of any other, nothing is estimated.
  RowClock(const std::vector<RawColumn>& table, ColumnMap columns, const std::string& path);
  void add(const RawBlock& block);

  struct Estimate {
    double period_s = 0.0;
    double std_s = 0.0;
  };
  /// Nullopt unless the joints that move agree.
  std::optional<Estimate> estimate() const;

 private:
  std::vector<double> values_of(const RawBlock& block, Channel channel) const;

  Matching matching_;
  std::vector<VelocityCheck> joints_;
  std::vector<double> rows_;
};

}  // namespace faultline
