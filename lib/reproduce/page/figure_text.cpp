// SPDX-License-Identifier: MIT
#include "lib/reproduce/page/figure_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

/// 3.4e-3 rather than 3.4e-03.
std::string short_scientific(double value) {
  if (value == 0.0) return "0";
  const int power = static_cast<int>(std::floor(elementary::log10(std::abs(value)) + 1e-9));
  const std::string mantissa = fmt::format("{:.1f}", value / elementary::pow(10.0, power));
  return mantissa == "10.0" ? fmt::format("1.0e{}", power + 1) : fmt::format("{}e{}", mantissa, power);
}

}  // namespace

std::string figure_text(double value, FigureStyle style) {
  if (std::isnan(value)) return "-";
  switch (style) {
    case FigureStyle::percent:
      return value == 1.0 ? "100 %" : fmt::format("{:.2f} %", 100.0 * value);
    case FigureStyle::decimal:
      return std::abs(value) >= 1000.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
    case FigureStyle::scientific:
      break;
  }
  return short_scientific(value);
}

std::string figure_text(const Measured& measured, FigureStyle style) {
  const double spread = measured.spread();
  std::string text = figure_text(measured.mean(), style);
  if (!std::isnan(spread) && spread > 0.0) text += " ± " + figure_text(spread, style);
  return text;
}

}  // namespace faultline
