// SPDX-License-Identifier: MIT
#include "lib/reproduce/page/result_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

std::vector<double> numbers(const std::vector<double>& values) {
  std::vector<double> found;
  for (const double value : values)
    if (!std::isnan(value)) found.push_back(value);
  return found;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(values.size());
}

/// 3.4e-3 rather than 3.4e-03.
std::string short_scientific(double value) {
  if (value == 0.0) return "0";
  const int power = static_cast<int>(std::floor(elementary::log10(std::abs(value)) + 1e-9));
  const std::string mantissa = fmt::format("{:.1f}", value / elementary::pow(10.0, power));
  return mantissa == "10.0" ? fmt::format("1.0e{}", power + 1) : fmt::format("{}e{}", mantissa, power);
}

}  // namespace

double Measured::mean() const { return mean_of(numbers(by_seed)); }

double Measured::spread() const {
  const std::vector<double> values = numbers(by_seed);
  if (values.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  const double centre = mean_of(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

bool Goal::reached() const {
  const double mean = measured.mean();
  return at_most ? mean <= bound : mean >= bound;
}

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
