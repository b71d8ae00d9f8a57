// SPDX-License-Identifier: MIT
#pragma once

#include "lib/compare/motion_pair.hpp"

namespace faultline {

/// Share of the rms speed below which a joint's place tells no time.
inline constexpr double kSlow = 0.05;

/// How much later the second run is, s, to a fraction of a sample; what differs by more than a tenth of the
/// motion does not count. Of a motion that repeats, the smallest of the shifts that are as good.
double best_shift(const MotionPair& motions, const RunSignals& first, const RunSignals& second);

}  // namespace faultline
