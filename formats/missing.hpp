// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace faultline {

/// Stands for a number that was not recorded or cannot be computed.
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace faultline
