// SPDX-License-Identifier: MIT
#include "lib/reproduce/page/result_table.hpp"

#include <cmath>
#include <limits>

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

}  // namespace faultline
