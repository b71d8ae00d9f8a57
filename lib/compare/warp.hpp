// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace faultline {

/// Samples at equal distances of several signals: [sample][signal].
using MotionSamples = std::vector<std::vector<double>>;

/// For each sample of `first` the place among those of `second` (with fractions, never decreasing) that makes
/// the sum of squared distances least: dynamic time warping. Both begin and both end together.
std::vector<double> warped_places(const MotionSamples& first, const MotionSamples& second);

}  // namespace faultline
