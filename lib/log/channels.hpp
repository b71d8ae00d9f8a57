// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

namespace faultline {

/// Where a canonical channel ("t", "q1", "dq2", "tau3", "q_ref1", "dq_ref1", "tau_ref1", "tau_meas1") comes
/// from and how its raw value becomes SI: value = sign * scale * (raw * unit factor) + offset.
struct ColumnSpec {
  std::string name{};  ///< column in the file; empty = find by the usual names
  std::string unit{};  ///< such as "deg", "mm", "ms", "ns"; empty = SI
  double sign = 1.0;   ///< +1 or -1
  double scale = 1.0;
  double offset = 0.0;  ///< in SI, added last
};

/// The meaning of a log's columns by canonical channel name; what is not named is found by the usual names.
using ColumnMap = std::map<std::string, ColumnSpec>;

}  // namespace faultline
