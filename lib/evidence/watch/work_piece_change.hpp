// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace faultline {

/// A work piece that the robot carries every day was picked up, or put down (less than 0).
struct WorkPieceChange {
  std::int64_t row = 0;
  double kg = 0.0;
};

}  // namespace faultline
