// SPDX-License-Identifier: MIT
#include "lib/residual/relation/relation_residual.hpp"

#include <algorithm>
#include <cmath>

#include "lib/log/log_channels.hpp"

namespace faultline {
namespace {

constexpr double kSettle_s = 0.15;  // not judged after an input outside the learned range, such as a jump

}  // namespace

bool RelationResidual::terms_are_known() const {
  // The position of a joint does not change how it follows its reference.
  const bool anywhere = relation_.kind == RelationKind::tracking && relation_.target == Quantity::q;
  for (std::size_t i = anywhere ? 1 : 0; i < relation_.term_low.size(); ++i) {
    const double term = line_.terms()[i];
    if (term < relation_.term_low[i] || term > relation_.term_high[i]) return false;
  }
  return true;
}

std::optional<RelationSample> RelationResidual::take(const Log& log, int row) {
  const double target = signals_of(log, relation_.target)[relation_.joint][row];
  if (!line_.take(log, row)) return std::nullopt;
  if (!terms_are_known()) {
    if (std::isfinite(unknown_s_) && log.time[row] - unknown_s_ < kSettle_s)
      beyond_s_ += log.time[row] - unknown_s_;
    unknown_s_ = log.time[row];
  }
  if (!std::isfinite(target) || log.time[row] - unknown_s_ < kSettle_s) return std::nullopt;
  double predicted = 0.0;
  double by_command = 0.0;
  const std::size_t of_command = relation_.lags + 1;
  for (std::size_t i = 0; i < relation_.weights.size(); ++i) {
    predicted += relation_.weights[i] * line_.terms()[i];
    if (i < of_command) by_command = predicted;
  }
  const bool drive = relation_.kind == RelationKind::actuator,
             motion = relation_.kind == RelationKind::tracking;
  double by_speed = drive ? predicted - by_command - relation_.weights.back() : 0.0;
  if (motion && std::isfinite(last_predicted_)) by_speed = predicted - last_predicted_;
  last_predicted_ = predicted;
  return RelationSample{log.time[row], line_.terms().front(), predicted, by_speed,
                        residual(target, predicted)};
}

/// Target minus prediction. A drive may not reach a predicted torque beyond the range of the healthy logs:
/// the residual is 0 from that range to the prediction, and if target and prediction are both beyond.
double RelationResidual::residual(double target, double predicted) const {
  if (relation_.kind == RelationKind::tracking) return target - predicted;
  const double reachable = std::clamp(predicted, relation_.low, relation_.high);
  const bool above = target >= relation_.high && predicted >= relation_.high;
  const bool below = target <= relation_.low && predicted <= relation_.low;
  if (above || below) return 0.0;
  return target - std::clamp(target, std::min(predicted, reachable), std::max(predicted, reachable));
}

}  // namespace faultline
