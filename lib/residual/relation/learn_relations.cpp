// SPDX-License-Identifier: MIT
#include "lib/residual/relation/learn_relations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/core/golden_section.hpp"
#include "lib/log/log.hpp"
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

SignalRelation with_memory(SignalRelation relation, double memory_s) {
  const int rows = std::max(kFewestLags, static_cast<int>(std::ceil(memory_s / relation.period_s)));
  relation.stride = (rows + kMostTrackingLags - 1) / kMostTrackingLags;
  relation.lags = (rows + relation.stride - 1) / relation.stride;
  return relation;
}

double largest_rate(std::span<LogSource* const> logs, const SignalRelation& relation) {
  double largest = 0.0;
  for (LogSource* log : logs) {
    log->rewind();
    double last = std::nan(""), last_s = 0.0;
    for (Log segment; log->next(segment);) {
      if (!has_signals(segment, relation)) continue;
      const std::vector<double>& values = signals_of(segment, relation.target)[relation.joint.index()];
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
                     .joint = Joint::at(j),
                     .target = target,
                     .inputs = {reference},
                     .period_s = period_s});
  };
  add(Quantity::q, Quantity::q_ref);
  add(Quantity::dq, Quantity::dq_ref);
  return out;
}

/// Returns one of them, fitted with the memory and the rate limit that explain the healthy logs best; nullopt
/// if the motion does not follow the reference.
std::optional<SignalRelation> fitted_tracking(std::span<LogSource* const> logs,
                                              const std::vector<Fold>& folds, double alarms_per_hour,
                                              const SignalRelation& relation) {
  std::optional<SignalRelation> best;
  const auto try_next = [&](SignalRelation candidate, double helps) {
    std::optional<SignalRelation> found = fitted(logs, folds, alarms_per_hour, std::move(candidate));
    if (found && (!best || middle_deviation(*found) < helps * middle_deviation(*best)))
      best = std::move(found);
  };
  for (const double memory_s : kMemories_s) try_next(with_memory(relation, memory_s), kHelps);
  if (!best) return std::nullopt;
  const double rate = best->r2 < kFollowsWell ? largest_rate(logs, *best) : 0.0;
  if (rate > 0.0) {
    SignalRelation limited = with_memory(relation, kMemories_s[0]);
    const auto deviation = [&](double share) {
      limited.rate_limit = share * rate;
      const std::optional<SignalRelation> found = fitted(logs, folds, alarms_per_hour, limited);
      return found ? middle_deviation(*found) : std::numeric_limits<double>::infinity();
    };
    limited.rate_limit = golden_section(kLeastRate, kMostRate, kRounds, deviation) * rate;
    try_next(std::move(limited), kRateHelps);
  }
  return best->r2 >= kFollows ? best : std::nullopt;
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
                     .joint = Joint::at(j),
                     .target = *measured,
                     .inputs = {*commanded},
                     .lags = lags_of(kActuatorMemory_s, options.period_s)});
    }
    if (!log.q_ref.empty() && (commanded || measured))
      out.push_back({.kind = RelationKind::control_law,
                     .joint = Joint::at(j),
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
  const std::vector<SignalRelation> to_fit = candidates(first, options);
  if (to_fit.empty()) return {};
  const std::vector<Fold> folds = folds_of(healthy);
  std::vector<SignalRelation> relations;
  for (const SignalRelation& candidate : to_fit) {
    std::optional<SignalRelation> relation =
        candidate.kind == RelationKind::tracking
            ? fitted_tracking(healthy, folds, options.alarms_per_hour, candidate)
            : fitted(healthy, folds, options.alarms_per_hour, candidate);
    if (!relation) continue;
    if (relation->kind == RelationKind::actuator) {
      const auto more = fitted(healthy, folds, options.alarms_per_hour, with_speed(*relation));
      if (more && speed_helps(*more, *relation)) relation = limited_by(*more, *relation);
      relation->offset_range = options.torque_offset * target_scale(*relation);
      relation->gain_range = options.torque_gain;
    }
    for (WindowLimit& window : relation->windows)
      window.limit = std::max(window.limit, options.least_share * target_scale(*relation));
    relations.push_back(*std::move(relation));
  }
  return relations;
}

}  // namespace faultline
