// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace faultline {

/// Equidistant samples of several signals: [sample][signal].
using MotionSamples = std::vector<std::vector<double>>;

/// Returns for each sample of `first` the place among those of `second` (fractional, never decreasing) that
/// minimises the sum of squared distances: dynamic time warping. First samples and last samples correspond.
std::vector<double> warped_places(const MotionSamples& first, const MotionSamples& second);

}  // namespace faultline
