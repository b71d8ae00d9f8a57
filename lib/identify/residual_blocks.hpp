// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace faultline {

/// Length, s, of the blocks over which residuals of `total_s` of logs may be alike in a sandwich covariance
/// of `parameters`: a second, on short logs less, since a covariance from fewer blocks than parameters is
/// none.
inline double residual_block_s(double total_s, double parameters) {
  // Bounds of a block's length, and how many blocks a parameter needs.
  constexpr double kLongest_s = 1.0, kShortest_s = 0.1, kBlocksPerParameter = 5.0;
  return std::clamp(total_s / (kBlocksPerParameter * parameters), kShortest_s, kLongest_s);
}

}  // namespace faultline
