// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// Makes a log of a table in which each row holds only some of the signals, as written by programs that merge
/// signals of different rates.
class SparseRows {
 public:
  /// The latest value of a signal.
  struct Held {
    double value = std::numeric_limits<double>::quiet_NaN();
    double since_s = -std::numeric_limits<double>::infinity();
    int rows = 0;  ///< rows without a value since then
  };

  /// Fills each missing value with the latest one, a joint signal for a moment only (judged_moment_s()), and
  /// removes the rows without any position. Segments follow each other.
  void gather(Log& segment, Issues& issues);

 private:
  std::vector<Held> held_;  ///< by channel
};

}  // namespace faultline
