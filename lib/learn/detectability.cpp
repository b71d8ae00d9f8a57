// SPDX-License-Identifier: MIT
#include "lib/learn/detectability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr double kSurely = 0.9;  // share of the logs in which a size must be found

/// Smallest size of a label that is found in nine of ten logs; NaN if there is none.
double detectable_size(const FaultLabel& label, const std::vector<std::vector<LeastFound>>& by_log) {
  std::vector<double> sizes;
  for (const std::vector<LeastFound>& log : by_log)
    for (const LeastFound& each : log)
      if (each.label == label) sizes.push_back(each.size);
  const double size = upper_quantile(std::move(sizes), kSurely);
  return std::isfinite(size) ? size : std::numeric_limits<double>::quiet_NaN();
}

Detectability detectability_of(const FaultLabel& label, std::span<const MonitoredRun> runs,
                               const std::vector<std::vector<LeastFound>>& by_log) {
  Detectability reach{.label = label};
  std::vector<double> sizes;
  std::vector<double> delays;
  for (const MonitoredRun& run : runs) {
    if (run.label != label) continue;
    const MonitoredEpisode* episode = episode_of_fault(run);
    ++reach.runs;
    if (episode) {
      ++reach.found;
      delays.push_back(episode->alarm_s() - run.onset_s);
    }
    if (std::isfinite(run.size)) sizes.push_back(std::abs(run.size));
  }
  reach.median_delay_s = lower_quantile(delays, 0.5);
  if (sizes.empty()) return reach;
  reach.size = detectable_size(label, by_log);
  reach.least_size = *std::min_element(sizes.begin(), sizes.end());
  return reach;
}

}  // namespace

std::vector<Detectability> detectability_of(std::span<const MonitoredRun> runs,
                                            const std::vector<std::vector<LeastFound>>& by_log) {
  std::vector<Detectability> all;
  for (const MonitoredRun& run : runs) {
    const bool known =
        std::any_of(all.begin(), all.end(), [&](const Detectability& r) { return r.label == run.label; });
    if (!known && run.label.kind != FaultKind::none) all.push_back(detectability_of(run.label, runs, by_log));
  }
  return all;
}

}  // namespace faultline
