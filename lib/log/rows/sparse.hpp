// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// Makes a log of a table in which each row holds some of the signals only, as programs write that merge
/// signals of different rates.
class SparseRows {
 public:
  /// Removes the rows without any position, and gives the others for each value that they lack the latest one
  /// there was, if any. Segments follow each other.
  void gather(Log& segment, Issues& issues);

 private:
  std::vector<double> held_;  ///< by channel, in the order of the log
};

}  // namespace faultline
