// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// A scale from values to pixels.
struct PlotAxis {
  double low = 0.0, high = 1.0;  ///< values at the ends; positive when logarithmic
  double from_px = 0.0, to_px = 1.0;
  bool logarithmic = false;

  double px(double value) const;
};

struct PlotTick {
  double value = 0.0;
  std::string text;
};

/// 1, 2 or 5 times a power of ten, the smallest with at most about `count` steps over `span`; it may be
/// smaller than that takes by a share of `tolerance`.
double tick_step(double span, int count, double tolerance = 0.0);

/// Ticks at 1, 2 or 5 times a power of ten (linear) or at powers of ten (logarithmic), about `count` of them.
std::vector<PlotTick> ticks_of(const PlotAxis& axis, int count);

/// How many ticks have room for their words along a horizontal axis, at most 10.
int tick_count(const PlotAxis& axis);

/// An axis over all finite (logarithmic: positive) values, a little wider than they are; 0 to 1 (0.1 to 1)
/// when there are none.
PlotAxis axis_over(const std::vector<const std::vector<double>*>& values, bool logarithmic);

}  // namespace faultline
