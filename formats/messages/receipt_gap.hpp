// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "lib/core/issue.hpp"

namespace faultline {

/// How much later messages were received than their headers say.
class ReceiptGap {
 public:
  void add(std::int64_t stamp_ns, std::int64_t receipt_ns) {
    if (stamp_ns == 0) return;
    const double gap_s = static_cast<double>(receipt_ns - stamp_ns) / 1e9;
    least_s_ = std::min(least_s_, gap_s);
    most_s_ = std::max(most_s_, gap_s);
    sum_s_ += gap_s;
    ++messages_;
  }
  /// Adds a note when some gap was met.
  void tell(Issues& issues) const;

 private:
  double least_s_ = std::numeric_limits<double>::infinity();
  double most_s_ = -std::numeric_limits<double>::infinity();
  double sum_s_ = 0.0;
  std::int64_t messages_ = 0;
};

}  // namespace faultline
