// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/coarse/coarse_judge.hpp"

namespace faultline {

/// Price in nats of a guess that cannot be integrated.
inline constexpr double kImpossibleAtCoarse = 1e14;

/// Returns the price of a guess in nats beside its residuals: for sizes that its kind does not have, for
/// measurements and forces that it excludes, for codes that repeat or do not. `from` is its first sample.
double coarse_price(const CoarseLog& log, const CoarseGuess& guess, const CoarseExplanation& fit, int from);

}  // namespace faultline
