// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "lib/core/elementary/double_double.hpp"

namespace faultline::elementary {

/// 2^(k / 128).
extern const std::array<DoubleDouble, 128> kRootsOfTwo;

}  // namespace faultline::elementary
