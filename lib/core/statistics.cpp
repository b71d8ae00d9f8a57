// SPDX-License-Identifier: MIT
#include "lib/core/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

/// Returns the value with `rank` values before it, at most the largest.
double ranked(std::span<double> values, double rank) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::size_t at = std::min(static_cast<std::size_t>(std::max(rank, 0.0)), values.size() - 1);
  const auto found = values.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(values.begin(), found, values.end());
  return *found;
}

}  // namespace

double upper_median_of(std::span<double> values) {
  return ranked(values, static_cast<double>(values.size() / 2));
}

double upper_median(std::vector<double> values) { return upper_median_of(values); }

double upper_quantile(std::vector<double> values, double share) {
  return ranked(values, share * static_cast<double>(values.size()));
}

double lower_quantile(std::vector<double> values, double share) {
  return ranked(values, share * (static_cast<double>(values.size()) - 1.0));
}

double nearest_rank_quantile(std::vector<double> values, double share) {
  return ranked(values, std::ceil(share * static_cast<double>(values.size())) - 1.0);
}

double normal_tail(double z) { return elementary::erfc(std::abs(z) / std::numbers::sqrt2); }

/// Uses the recurrence over degrees of freedom, from 1 and 2 (Abramowitz and Stegun 26.4.8).
double chi_square_tail(double x, int degrees) {
  if (!(x > 0.0)) return 1.0;
  const bool odd = degrees % 2 == 1;
  double tail = odd ? normal_tail(std::sqrt(x)) : elementary::exp(-0.5 * x);
  double log_term = -0.5 * x + (odd ? 0.5 * elementary::log(2.0 * x / std::numbers::pi) : 0.0);
  for (int k = odd ? 3 : 4; k <= degrees; k += 2) {
    log_term += odd && k == 3 ? 0.0 : elementary::log(x / (k - 2));
    tail += elementary::exp(log_term);
  }
  return tail;
}

/// Uses the finite series (Abramowitz and Stegun 26.7.3 and 26.7.4).
double student_tail(double t, int degrees) {
  const double theta = elementary::atan(std::abs(t) / std::sqrt(degrees));
  const auto [sine, cosine] = elementary::sin_cos(theta);
  const double square = cosine * cosine;
  const bool odd = degrees % 2 == 1;
  double term = odd ? cosine : 1.0, sum = 0.0;
  for (int k = odd ? 3 : 2; k <= degrees; k += 2) {
    sum += term;
    term *= square * (k - 1) / k;
  }
  const double inside = odd ? (theta + sine * sum) * 2.0 / std::numbers::pi : sine * sum;
  return std::fmax(1.0 - inside, 0.0);
}

}  // namespace faultline
