// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/coarse/coarse_judge.hpp"

namespace faultline {

/// Nats that a guess costs that cannot be.
inline constexpr double kImpossibleAtCoarse = 1e14;

/// Nats that a guess costs beside what it leaves of the readings: sizes that its kind does not have, readings
/// and forces that it takes out of the evidence, codes that repeat or do not. `from` is its first sample.
double coarse_price(const CoarseLog& log, const CoarseGuess& guess, const CoarseExplanation& fit, int from);

}  // namespace faultline
