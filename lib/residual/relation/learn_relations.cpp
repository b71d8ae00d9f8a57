// SPDX-License-Identifier: MIT
#include "lib/residual/relation/learn_relations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/golden_section.hpp"
#include "lib/log/log_channels.hpp"
#include "lib/residual/relation/relation_fit.hpp"

namespace faultline {
namespace {

constexpr double kActuatorMemory_s = 0.03;  // length of the lags: of a current loop and its filter
constexpr double kLawMemory_s = 0.01;       // length of the lags: of a controller's filters
constexpr int kFewestLags = 2, kMostLags = 16, kMostTrackingLags = 8;

constexpr double kHelps = 0.75;  // ratio of middle_deviation(): below it speed or a longer memory is used
constexpr double kOfPlain = 1.0 / 3.0;  // ratio of the limits with speed to those without, at least
constexpr double kKeepsGain = 0.8;      // ratio of the command's weights: below it the speed is not used

constexpr double kMemories_s[] = {0.1, 0.4, 1.6};  // of position loops, from stiff to soft
constexpr double kRateHelps = 0.5;                 // the same ratio for a rate limit
constexpr double kFollows = 0.5;        // share of the target's variance that its reference explains at least
constexpr double kFollowsWell = 0.999;  // share of the same from which on no rate limit is tried
constexpr double kSlope_s = 0.1;        // time over which rates are measured
constexpr double kLeastRate = 0.5, kMostRate = 1.1;  // bounds of a rate limit, of the largest rate in logs
constexpr int kRounds = 9;

void set_memory(SignalRelation& relation, double memory_s) {
  const int rows = std::max(kFewestLags, static_cast<int>(std::ceil(memory_s / relation.period_s)));
  relation.stride = (rows + kMostTrackingLags - 1) / kMostTrackingLags;
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

/// Returns tracking relations to be fitted: of position and velocity, for joints with a logged reference.
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

/// Fits one of them, with the memory and the rate limit that explain the healthy logs best. Returns false if
/// the motion does not follow the reference.
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
    if (!is_better(candidate, kHelps)) continue;
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

int lags_of(double memory_s, double period_s) {
  return std::clamp(static_cast<int>(std::ceil(memory_s / period_s)), kFewestLags, kMostLags);
}

/// Returns relations to be fitted, for each joint and by the signals that the log has.
std::vector<SignalRelation> candidates(const Log& log, const RelationOptions& options) {
  const auto commanded = commanded_torque(log, options.torque_is_commanded);
  const auto measured = measured_torque(log, options.torque_is_commanded);
  std::vector<Quantity> read;  // inputs of the controller
  for (const Quantity quantity : {Quantity::q_ref, Quantity::dq_ref, Quantity::q, Quantity::dq})
    if (!signals_of(log, quantity).empty()) read.push_back(quantity);
  std::vector<SignalRelation> out;
  for (int j = 0; j < log.joints(); ++j) {
    if (commanded && measured) {
      out.push_back({.kind = RelationKind::actuator,
                     .joint = j,
                     .target = *measured,
                     .inputs = {*commanded},
                     .lags = lags_of(kActuatorMemory_s, options.period_s)});
    }
    if (!log.q_ref.empty() && (commanded || measured))
      out.push_back({.kind = RelationKind::control_law,
                     .joint = j,
                     .target = commanded ? *commanded : *measured,
                     .inputs = read,
                     .lags = lags_of(kLawMemory_s, options.period_s)});
  }
  for (SignalRelation& relation : out) relation.period_s = options.period_s;
  for (SignalRelation& relation : tracking_candidates(log, options.period_s))
    out.push_back(std::move(relation));
  return out;
}

/// Returns the relation of a drive with its speed as further input: the induced voltage of the motor acts on
/// the current loop.
SignalRelation with_speed(SignalRelation drive) {
  drive.inputs.push_back(Quantity::dq);
  return drive;
}

/// Whether the speed improves the relation, but does not replace the command: a drive that gives another
/// torque, and so another speed, would then seem healthy.
bool speed_helps(const SignalRelation& with_speed, const SignalRelation& plain) {
  return middle_deviation(with_speed) < kHelps * middle_deviation(plain) &&
         with_speed.weights[0] > kKeepsGain * plain.weights[0];
}

/// Bounds the limits by a share of those without speed, since few logs determine the part of the speed.
SignalRelation limited_by(SignalRelation relation, const SignalRelation& plain) {
  for (std::size_t w = 0; w < std::min(relation.windows.size(), plain.windows.size()); ++w)
    relation.windows[w].limit = std::max(relation.windows[w].limit, kOfPlain * plain.windows[w].limit);
  return relation;
}

}  // namespace

std::vector<SignalRelation> learn_relations(std::span<LogSource* const> healthy,
                                            const RelationOptions& options) {
  if (healthy.empty() || !(options.period_s > 0.0)) return {};
  Log first;
  healthy.front()->rewind();
  if (!healthy.front()->next(first)) return {};
  std::vector<SignalRelation> relations = candidates(first, options);
  if (relations.empty()) return {};
  const std::vector<Fold> folds = folds_of(healthy);
  std::erase_if(relations, [&](SignalRelation& relation) {
    return relation.kind == RelationKind::tracking
               ? !fit_tracking(healthy, folds, options.alarms_per_hour, relation)
               : !fit(healthy, folds, options.alarms_per_hour, relation);
  });
  for (SignalRelation& relation : relations) {
    SignalRelation more = with_speed(relation);
    const bool drive = relation.kind == RelationKind::actuator;
    if (drive && fit(healthy, folds, options.alarms_per_hour, more) && speed_helps(more, relation))
      relation = limited_by(std::move(more), relation);
  }
  for (SignalRelation& relation : relations) {
    for (WindowLimit& window : relation.windows)
      window.limit = std::max(window.limit, options.least_share * target_scale(relation));
    if (relation.kind != RelationKind::actuator) continue;
    relation.offset_range = options.torque_offset * target_scale(relation);
    relation.gain_range = options.torque_gain;
  }
  return relations;
}

}  // namespace faultline
