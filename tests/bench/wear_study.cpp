// SPDX-License-Identifier: MIT
// The rates in docs/history.md: changes and intervals on simulated series whose truth is known.
//   cmake --build --preset release --target faultline_wear_study && build/release/tests/faultline_wear_study
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "lib/wear/series_trend.hpp"
#include "tests/wear/simulated_series.hpp"

using namespace faultline;

namespace {

constexpr int kSeries = 4000;  // a number

double share_with_changes(const SeriesTruth& truth, double false_alarms) {
  Random random(static_cast<std::uint64_t>(truth.logs));
  int found = 0;
  for (int i = 0; i < kSeries; ++i)
    found += !series_trend(simulated_series(truth, random), false_alarms).changes.empty();
  return 100.0 * found / kSeries;
}

double share_covered(const SeriesTruth& truth) {
  Random random(static_cast<std::uint64_t>(truth.logs));
  int covered = 0;
  for (int i = 0; i < kSeries; ++i) {
    const SeriesTrend trend = series_trend(simulated_series(truth, random), 0.0);
    covered += trend.slope_ci95[0] <= truth.slope && truth.slope <= trend.slope_ci95[1];
  }
  return 100.0 * covered / kSeries;
}

SeriesTruth healthy(int logs) {
  SeriesTruth truth;
  truth.logs = logs;
  truth.between_std = 2.0;
  return truth;
}

void print_rates() {
  for (const int logs : {6, 8, 10, 12, 20, 40, 100}) {
    std::printf("healthy, %d logs: %.2f %% at 1 %%, slope within its interval %.1f %%\n", logs,
                share_with_changes(healthy(logs), 0.01), share_covered(healthy(logs)));
    SeriesTruth heavy = healthy(logs);
    heavy.heavy_tails = true;
    std::printf("  heavy tails: %.2f %%\n", share_with_changes(heavy, 0.01));
    double worst = 0.0;
    for (const double slope : {0.05, 0.1, 0.2, 0.4, 0.8}) {
      SeriesTruth trend = healthy(logs);
      trend.between_std = 1.0;
      trend.slope = slope * 20.0 / logs;
      worst = std::max(worst, share_with_changes(trend, 0.01));
    }
    std::printf("  the worst trend: %.2f %%\n", worst);
    for (const double correlation : {0.3, 0.6, 0.8}) {
      SeriesTruth wandering = healthy(logs);
      wandering.correlation = correlation;
      std::printf("  correlation %.1f: %.2f %%, slope within its interval %.1f %%\n", correlation,
                  share_with_changes(wandering, 0.01), share_covered(wandering));
    }
  }
}

void print_power() {
  const double scatter = std::sqrt(1.0 + 1.75);  // between logs, and mean variance of a log
  for (const int logs : {8, 12, 20, 40})
    for (const double size : {3.0, 5.0, 7.0}) {
      SeriesTruth truth;
      truth.logs = logs;
      truth.jump = size * scatter;
      truth.jump_at = logs / 2;
      std::printf("step of %.0f scatters in %d logs: found in %.1f %% at 0.1 %%\n", size, logs,
                  share_with_changes(truth, 0.001));
    }
}

}  // namespace

int main() {
  print_rates();
  print_power();
}
