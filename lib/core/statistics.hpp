// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

/// Order statistics. Each is one of the values (nothing is interpolated), or NaN if there are none; no value
/// may be NaN.
namespace faultline {

/// Returns the middle value; for an even number the larger of the two in the middle.
double upper_median(std::vector<double> values);
/// The same without a copy: reorders `values`.
double upper_median_of(std::span<double> values);

/// Returns the value with floor(share n) values before it, the largest for a share of 1; upper_quantile(0.5)
/// is upper_median.
double upper_quantile(std::vector<double> values, double share);

/// Returns the value with floor(share (n - 1)) values before it.
double lower_quantile(std::vector<double> values, double share);

/// Returns the smallest value that at least `share` of the values do not exceed.
double nearest_rank_quantile(std::vector<double> values, double share);

}  // namespace faultline
