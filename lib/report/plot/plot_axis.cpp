// SPDX-License-Identifier: MIT
#include "lib/report/plot/plot_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

std::vector<PlotTick> linear_ticks(const PlotAxis& axis, int count) {
  std::vector<PlotTick> ticks;
  const double step = tick_step(axis.high - axis.low, count, 0.001);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-elementary::log10(step) - 1e-9)), 0, 12);
  const auto first = static_cast<long long>(std::ceil(axis.low / step - 1e-9));
  const auto last = static_cast<long long>(std::floor(axis.high / step + 1e-9));
  for (long long k = first; k <= last; ++k) {
    const double value = static_cast<double>(k) * step;
    ticks.push_back({value, std::abs(value) >= 1e6 ? fmt::format("{:.1e}", value)
                                                   : fmt::format("{:.{}f}", value, decimals)});
  }
  return ticks;
}

std::vector<PlotTick> log_ticks(const PlotAxis& axis, int count) {
  const int first = static_cast<int>(std::ceil(elementary::log10(axis.low) - 1e-9));
  const int last = static_cast<int>(std::floor(elementary::log10(axis.high) + 1e-9));
  const int stride = std::max(1, (last - first + count) / std::max(count, 1));
  std::vector<PlotTick> ticks;
  for (int power = first; power <= last; power += stride)
    ticks.push_back({elementary::pow(10.0, power), power >= -3 && power <= 4
                                                       ? fmt::format("{:g}", elementary::pow(10.0, power))
                                                       : fmt::format("1e{}", power)});
  return ticks;
}

}  // namespace

double tick_step(double span, int count, double tolerance) {
  const double rough = span / std::max(count, 1);
  const double power = elementary::pow(10.0, std::floor(elementary::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1.0 - tolerance)) return factor * power;
  return 10.0 * power;
}

double PlotAxis::px(double value) const {
  const double share =
      logarithmic ? elementary::log(value / low) / elementary::log(high / low) : (value - low) / (high - low);
  return from_px + share * (to_px - from_px);
}

std::vector<PlotTick> ticks_of(const PlotAxis& axis, int count) {
  return axis.logarithmic ? log_ticks(axis, count) : linear_ticks(axis, count);
}

int tick_count(const PlotAxis& axis) {
  constexpr double kRoom = 66.0;  // px
  constexpr int kMost = 10;
  return std::clamp(static_cast<int>(std::abs(axis.to_px - axis.from_px) / kRoom), 2, kMost);
}

PlotAxis axis_over(const std::vector<const std::vector<double>*>& values, bool logarithmic) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::vector<double>* list : values)
    for (const double value : *list) {
      if (!std::isfinite(value) || (logarithmic && !(value > 0.0))) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  PlotAxis axis{.logarithmic = logarithmic};
  if (!(low <= high)) return logarithmic ? PlotAxis{.low = 0.1, .high = 1.0, .logarithmic = true} : axis;
  if (logarithmic) {
    axis.low = elementary::pow(10.0, std::floor(elementary::log10(low)));
    axis.high = elementary::pow(10.0, std::ceil(elementary::log10(high)));
    if (axis.low == axis.high) axis.high *= 10.0;
    return axis;
  }
  const double span = high - low;
  const double margin = span > 0.0 ? 0.05 * span : std::max(0.5 * std::abs(high), 0.5);
  axis.low = low - margin;
  axis.high = high + margin;
  return axis;
}

}  // namespace faultline
