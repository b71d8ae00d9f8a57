// SPDX-License-Identifier: MIT
#include "lib/residual/relation/signal_relation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/enum_named.hpp"
#include "lib/core/error.hpp"
#include "lib/core/json/json_fields.hpp"
#include "lib/log/log.hpp"

namespace faultline {
namespace {

constexpr double kFarDay = 1.65;  // times the normal range of days: one day in a thousand is beyond it

bool has(const Log& log, Quantity quantity, Joint joint) {
  return joint.index() < std::ssize(signals_of(log, quantity));
}

std::optional<Quantity> torque_of(const Log& log, Quantity quantity, bool tau_is_it) {
  if (tau_is_it && !log.tau.empty()) return Quantity::tau;
  if (!signals_of(log, quantity).empty()) return quantity;
  return std::nullopt;
}

/// Name of a quantity without the number of a joint, such as "tau_meas".
std::string name_of(Quantity quantity) {
  std::string name = to_string(Channel{quantity, 1_joint});
  name.pop_back();
  return name;
}

Quantity quantity_from(const std::string& name, const std::string& where) {
  const auto channel = canonical_channel(name + "1");
  if (channel) return channel->quantity;
  throw Error(ErrorCode::input, where, "has a relation of the unknown signal \"" + name + "\"");
}

std::vector<std::string> names_of(const std::vector<Quantity>& quantities) {
  std::vector<std::string> names;
  for (const Quantity quantity : quantities) names.push_back(name_of(quantity));
  return names;
}

std::vector<Quantity> quantities_from(const std::vector<std::string>& names, const std::string& where) {
  std::vector<Quantity> quantities;
  for (const std::string& name : names) quantities.push_back(quantity_from(name, where));
  return quantities;
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

bool fits(const SignalRelation& relation, int joints) {
  const bool shape = !relation.joint.is_none() && relation.joint.index() < joints &&
                     !relation.inputs.empty() && relation.lags >= 0 && relation.lags <= 100 &&
                     relation.stride >= 1 && relation.stride <= 10'000 && relation.rate_limit >= 0.0 &&
                     static_cast<int>(relation.weights.size()) == relation.weights_needed() &&
                     relation.term_low.size() + 1 == relation.weights.size() &&
                     relation.term_high.size() == relation.term_low.size();
  const bool windows =
      !relation.windows.empty() && relation.windows.size() <= 100 &&
      std::all_of(relation.windows.begin(), relation.windows.end(), [](const WindowLimit& w) {
        return w.window_s > 0.0 && w.std > 0.0 && w.limit > 0.0 && w.limit < 1e12;
      });
  const bool rising = std::is_sorted(relation.windows.begin(), relation.windows.end(),
                                     [](const auto& a, const auto& b) { return a.window_s < b.window_s; });
  return shape && windows && rising && relation.period_s > 0.0 && relation.low <= relation.high &&
         relation.offset_range >= 0.0 && relation.gain_range >= 0.0 && relation.gain_range < 1.0 &&
         all_finite(relation.weights) && all_finite(relation.term_low) && all_finite(relation.term_high);
}

}  // namespace

const char* to_string(RelationKind kind) {
  static constexpr std::array kNames{"actuator", "control_law", "tracking"};
  static_assert(kNames.size() == static_cast<std::size_t>(RelationKind::tracking) + 1);
  return kNames[static_cast<std::size_t>(kind)];
}

RelationKind relation_kind_from(const std::string& name, const std::string& where) {
  if (const auto kind =
          enum_named(name, {RelationKind::actuator, RelationKind::control_law, RelationKind::tracking}))
    return *kind;
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

void fields(auto& v, MaybeConst<WindowLimit> auto& window) {
  v("window_s", window.window_s);
  v("std", window.std);
  v("limit", window.limit);
}

void fields(auto& v, MaybeConst<SignalRelation> auto& relation) {
  v.named("kind", relation.kind, relation_kind_from);
  v("joint", relation.joint);
  v.as("target", relation.target, name_of, quantity_from);
  v.as("inputs", relation.inputs, names_of, quantities_from);
  v("lags", relation.lags);
  v("stride", relation.stride);
  v("rate_limit", relation.rate_limit);
  v("period_s", relation.period_s);
  v("weights", relation.weights);
  v("low", relation.low);
  v("high", relation.high);
  v("term_low", relation.term_low);
  v("term_high", relation.term_high);
  v.finite("r2", relation.r2);
  v("windows", relation.windows);
  v("offset_range", relation.offset_range);
  v("gain_range", relation.gain_range);
}

nlohmann::json relations_to_json(const std::vector<SignalRelation>& relations) {
  return fields_to_json<nlohmann::json>(relations);
}

std::vector<SignalRelation> relations_from_json(const nlohmann::json& list, int joints,
                                                const std::string& where) {
  auto relations = fields_from_json<std::vector<SignalRelation>>(list, where);
  for (std::size_t i = 0; i < relations.size(); ++i)
    if (!fits(relations[i], joints))
      throw Error(
          ErrorCode::input, where,
          fmt::format("has an inconsistent relation between signals (entry {}); learn the model again",
                      i + 1));
  return relations;
}

}  // namespace faultline
