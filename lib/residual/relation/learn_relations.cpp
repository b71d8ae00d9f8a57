// SPDX-License-Identifier: MIT
#include "lib/residual/relation/learn_relations.hpp"

#include <algorithm>
#include <cmath>

#include "lib/log/log_channels.hpp"
#include "lib/residual/relation/relation_fit.hpp"

namespace faultline {
namespace {

constexpr double kActuatorMemory_s = 0.03;  // length of the lags: of a current loop and its filter
constexpr double kLawMemory_s = 0.01;       // length of the lags: of a controller's filters
constexpr int kFewestLags = 2, kMostLags = 16;

constexpr double kHelps = 0.75;         // ratio of middle_deviation(): below it the speed is used
constexpr double kOfPlain = 1.0 / 3.0;  // ratio of the limits with speed to those without, at least
constexpr double kKeepsGain = 0.8;      // ratio of the command's weights: below it the speed is not used

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

std::vector<SignalRelation> candidates(LogSource& log, const RelationOptions& options) {
  Log first;
  log.rewind();
  return log.next(first) ? candidates(first, options) : std::vector<SignalRelation>{};
}

}  // namespace

std::vector<SignalRelation> learn_relations(std::span<LogSource* const> healthy,
                                            const RelationOptions& options) {
  if (healthy.empty() || !(options.period_s > 0.0)) return {};
  std::vector<SignalRelation> relations = candidates(*healthy.front(), options);
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
