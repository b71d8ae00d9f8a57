// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "lib/core/random.hpp"
#include "lib/wear/weighted_series.hpp"

namespace faultline {

/// The truth of a series: a line, a jump and noise, of the logs and between them.
struct SeriesTruth {
  int logs = 20;
  double slope = 0.0;  ///< per unit of `at`
  double jump = 0.0;   ///< from log `jump_at` on
  int jump_at = 0;
  double between_std = 1.0;  ///< from log to log
  double correlation = 0.0;  ///< of that scatter between neighbours
  bool heavy_tails = false;  ///< that scatter is Student's t with three degrees of freedom
};

/// Standard normal, or Student's t with three degrees of freedom.
inline double simulated_scatter(bool heavy_tails, Random& random) {
  const double normal = random.normal();
  if (!heavy_tails) return normal;
  double squares = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double one = random.normal();
    squares += one * one;
  }
  return normal / std::sqrt(squares / 3.0);
}

/// Logs at uneven times, with standard deviations between 0.5 and 2.
inline std::vector<SeriesPoint> simulated_series(const SeriesTruth& truth, Random& random) {
  std::vector<SeriesPoint> points;
  double at = 0.0, shared = 0.0;
  for (int i = 0; i < truth.logs; ++i) {
    const double std = random.uniform(0.5, 2.0), c = truth.correlation;
    const double fresh = simulated_scatter(truth.heavy_tails, random);
    at += random.uniform(0.2, 2.0);
    shared = i == 0 ? fresh : c * shared + std::sqrt(1.0 - c * c) * fresh;
    const double value = 5.0 + truth.slope * at + (i >= truth.jump_at ? truth.jump : 0.0) +
                         truth.between_std * shared + std * random.normal();
    points.push_back({at, value, std});
  }
  return points;
}

}  // namespace faultline
