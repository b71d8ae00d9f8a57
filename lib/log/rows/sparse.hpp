// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// Makes a log of a table in which each row holds some of the signals only, as programs write that merge
/// signals of different rates.
class SparseRows {
 public:
  /// The latest value of a signal.
  struct Held {
    double value = std::numeric_limits<double>::quiet_NaN();
    double since_s = -std::numeric_limits<double>::infinity();
    int rows = 0;  ///< that were without one since
  };

  /// Removes the rows without any position, and gives the others for each value that they lack the latest one
  /// there was, if any. Segments follow each other.
  void gather(Log& segment, Issues& issues);

 private:
  std::vector<Held> held_;  ///< by channel
};

}  // namespace faultline
