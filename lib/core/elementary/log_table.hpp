// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace faultline::elementary {

/// For mantissas m from 1 + k / 128 on, 128 of them up to 2; those from kFirstHalved on stand for m / 2.
struct LogEntry {
  double inverse;            ///< about 1 / m, in ten bits, so that products with half a mantissa are exact
  double log_high, log_low;  ///< -log(inverse); the high part is a multiple of 2^-42
};
inline constexpr int kFirstHalved = 52;
extern const std::array<LogEntry, 128> kLogEntries;

}  // namespace faultline::elementary
