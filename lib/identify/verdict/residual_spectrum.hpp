// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/verdict/residual_pattern.hpp"

namespace faultline {

/// Fills in the spectrum of what is left, up to what windows half over each other can tell: the mean power of
/// stretches of some seconds under a Hann taper (Welch 1967). Windows average over themselves, so that it
/// falls off towards 1 / window. Empty when no log is long enough.
void add_spectrum(const JointFit& fit, ResidualPattern& pattern);

}  // namespace faultline
