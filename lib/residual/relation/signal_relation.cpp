// SPDX-License-Identifier: MIT
#include "lib/residual/relation/signal_relation.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"
#include "lib/log/log_channels.hpp"

namespace faultline {
namespace {

constexpr double kFarDay = 1.65;  // times the normal range of days: one day in a thousand is beyond it

bool has(const Log& log, Quantity quantity, int joint) {
  return static_cast<int>(signals_of(log, quantity).size()) > joint;
}

std::optional<Quantity> torque_of(const Log& log, Quantity quantity, bool tau_is_it) {
  if (tau_is_it && !log.tau.empty()) return Quantity::tau;
  if (!signals_of(log, quantity).empty()) return quantity;
  return std::nullopt;
}

}  // namespace

const char* to_string(RelationKind kind) {
  switch (kind) {
    case RelationKind::actuator:
      return "actuator";
    case RelationKind::control_law:
      return "control_law";
    case RelationKind::tracking:
      return "tracking";
  }
  return "tracking";
}

RelationKind relation_kind_from(const std::string& name, const std::string& where) {
  for (const RelationKind kind : kRelationKinds)
    if (name == to_string(kind)) return kind;
  throw Error(ErrorCode::input, where,
              "has the unknown relation \"" + name + "\"; expected actuator, control_law or tracking");
}

double allowed_mean(const SignalRelation& relation, int window, double torque, double by_speed) {
  const double by_days =
      elementary::hypot(kFarDay * relation.offset_range, kFarDay * relation.gain_range * torque);
  return elementary::hypot(elementary::hypot(relation.windows[window].limit, by_days), by_speed);
}

std::optional<Quantity> commanded_torque(const Log& log, bool torque_is_commanded) {
  return torque_of(log, Quantity::tau_ref, torque_is_commanded);
}

std::optional<Quantity> measured_torque(const Log& log, bool torque_is_commanded) {
  return torque_of(log, Quantity::tau_meas, !torque_is_commanded);
}

bool has_torque(const Log& log) { return !log.tau.empty() || !log.tau_ref.empty() || !log.tau_meas.empty(); }

bool has_signals(const Log& log, const SignalRelation& relation) {
  return has(log, relation.target, relation.joint) &&
         std::all_of(relation.inputs.begin(), relation.inputs.end(),
                     [&](Quantity input) { return has(log, input, relation.joint); });
}

}  // namespace faultline
