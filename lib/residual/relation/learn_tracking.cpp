// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "lib/core/golden_section.hpp"
#include "lib/log/log_channels.hpp"
#include "lib/residual/relation/relation_fit.hpp"

namespace faultline {
namespace {

constexpr double kMemories_s[] = {0.1, 0.4, 1.6};  // of position loops, from stiff to soft
constexpr int kTrackingFewestLags = 2, kTrackingMostLags = 8;
constexpr double kTrackingHelps = 0.75;  // ratio of middle_deviation(): below it a longer memory is used
constexpr double kRateHelps = 0.5;       // the same ratio for a rate limit
constexpr double kFollows = 0.5;        // share of the target's variance that its reference explains at least
constexpr double kFollowsWell = 0.999;  // share of the same from which on no rate limit is tried
constexpr double kSlope_s = 0.1;        // time over which rates are measured
constexpr double kLeastRate = 0.5, kMostRate = 1.1;  // bounds of a rate limit, of the largest rate in logs
constexpr int kRounds = 9;

void set_memory(SignalRelation& relation, double memory_s) {
  const int rows = std::max(kTrackingFewestLags, static_cast<int>(std::ceil(memory_s / relation.period_s)));
  relation.stride = (rows + kTrackingMostLags - 1) / kTrackingMostLags;
  relation.lags = (rows + relation.stride - 1) / relation.stride;
}

double largest_rate(std::span<LogSource* const> logs, const SignalRelation& relation) {
  double largest = 0.0;
  for (LogSource* log : logs) {
    log->rewind();
    double last = std::nan(""), last_s = 0.0;
    for (Log segment; log->next(segment);) {
      if (!has_signals(segment, relation)) continue;
      const std::vector<double>& values = signals_of(segment, relation.target)[relation.joint];
      for (int k = 0; k < segment.rows(); ++k) {
        if (std::isfinite(last) && segment.time[k] - last_s < kSlope_s) continue;
        if (std::isfinite(last) && std::isfinite(values[k]) && segment.time[k] - last_s < 2.0 * kSlope_s)
          largest = std::max(largest, std::abs(values[k] - last) / (segment.time[k] - last_s));
        last = values[k], last_s = segment.time[k];
      }
    }
  }
  return largest;
}

}  // namespace

std::vector<SignalRelation> tracking_candidates(const Log& log, double period_s) {
  std::vector<SignalRelation> out;
  const auto add = [&](Quantity target, Quantity reference) {
    const auto joints = std::min(signals_of(log, target).size(), signals_of(log, reference).size());
    for (int j = 0; j < static_cast<int>(joints); ++j)
      out.push_back({.kind = RelationKind::tracking,
                     .joint = j,
                     .target = target,
                     .inputs = {reference},
                     .period_s = period_s});
  };
  add(Quantity::q, Quantity::q_ref);
  add(Quantity::dq, Quantity::dq_ref);
  return out;
}

bool fit_tracking(std::span<LogSource* const> logs, const std::vector<Fold>& folds, double alarms_per_hour,
                  SignalRelation& relation) {
  bool fits = false;
  SignalRelation best = relation;
  const auto is_better = [&](SignalRelation& candidate, double helps) {
    return fit(logs, folds, alarms_per_hour, candidate) &&
           (!fits || middle_deviation(candidate) < helps * middle_deviation(best));
  };
  for (const double memory_s : kMemories_s) {
    SignalRelation candidate = relation;
    set_memory(candidate, memory_s);
    if (!is_better(candidate, kTrackingHelps)) continue;
    best = std::move(candidate);
    fits = true;
  }
  if (!fits) return false;
  const double rate = best.r2 < kFollowsWell ? largest_rate(logs, best) : 0.0;
  if (rate > 0.0) {
    SignalRelation limited = relation;
    set_memory(limited, kMemories_s[0]);
    const auto straying = [&](double share) {
      limited.rate_limit = share * rate;
      return fit(logs, folds, alarms_per_hour, limited) ? middle_deviation(limited)
                                                        : std::numeric_limits<double>::infinity();
    };
    limited.rate_limit = golden_section(kLeastRate, kMostRate, kRounds, straying) * rate;
    if (is_better(limited, kRateHelps)) best = std::move(limited);
  }
  relation = std::move(best);
  return relation.r2 >= kFollows;
}

}  // namespace faultline
