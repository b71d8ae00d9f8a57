// SPDX-License-Identifier: MIT
#include "lib/pipeline/reach.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr double kSurely = 0.9;  // share found
constexpr int kFewestAbove = 5;  // runs of that size or more: fewer say nothing

struct Trial {
  double size = 0.0;
  bool found = false;
};

/// A stretch of sizes with one share found.
struct Block {
  double least = 0.0;
  int runs = 0;
  int found = 0;

  double share() const { return static_cast<double>(found) / runs; }
};

/// Pools neighbours until the share rises from block to block.
std::vector<Block> rising(const std::vector<Trial>& by_size) {
  std::vector<Block> blocks;
  for (const Trial& trial : by_size) {
    blocks.push_back({trial.size, 1, trial.found ? 1 : 0});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].share() >= blocks.back().share()) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().runs += last.runs;
      blocks.back().found += last.found;
    }
  }
  return blocks;
}

double surely_found_from(std::vector<Trial> trials) {
  std::sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) { return a.size < b.size; });
  double from = std::numeric_limits<double>::quiet_NaN();
  int above = 0;
  const std::vector<Block> blocks = rising(trials);
  for (auto block = blocks.rbegin(); block != blocks.rend() && block->share() >= kSurely; ++block) {
    above += block->runs;
    if (above >= kFewestAbove) from = block->least;
  }
  return from;
}

Reach reach_of(const FaultLabel& label, std::span<const MonitoredRun> runs) {
  Reach reach{.label = label};
  std::vector<Trial> trials;
  std::vector<double> delays;
  for (const MonitoredRun& run : runs) {
    if (run.label != label) continue;
    const MonitoredEpisode* episode = episode_of_fault(run);
    ++reach.runs;
    if (episode) {
      ++reach.found;
      delays.push_back(episode->alarm_s() - run.onset_s);
    }
    if (std::isfinite(run.size)) trials.push_back({std::abs(run.size), episode != nullptr});
  }
  reach.median_delay_s = lower_quantile(delays, 0.5);
  if (trials.empty()) return reach;
  reach.size = surely_found_from(trials);
  reach.least_size = trials.front().size;
  for (const Trial& trial : trials) reach.least_size = std::min(reach.least_size, trial.size);
  return reach;
}

}  // namespace

std::vector<Reach> reach_of(std::span<const MonitoredRun> runs) {
  std::vector<Reach> all;
  for (const MonitoredRun& run : runs) {
    const bool known =
        std::any_of(all.begin(), all.end(), [&](const Reach& r) { return r.label == run.label; });
    if (!known && run.label.kind != FaultKind::none) all.push_back(reach_of(run.label, runs));
  }
  return all;
}

}  // namespace faultline
