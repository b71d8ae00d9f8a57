// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace faultline {

/// Returns the length, s, of blocks over which residuals of `total_s` of logs may be correlated, for a
/// covariance of `parameters`: a second, less on short logs, since fewer blocks than parameters give no
/// covariance.
inline double residual_block_s(double total_s, double parameters) {
  // Bounds of a block's length, and the number of blocks for each parameter.
  constexpr double kLongest_s = 1.0, kShortest_s = 0.1, kBlocksPerParameter = 5.0;
  return std::clamp(total_s / (kBlocksPerParameter * parameters), kShortest_s, kLongest_s);
}

}  // namespace faultline
