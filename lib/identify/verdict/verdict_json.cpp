// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/verdict_json.hpp"

#include "lib/core/json_values.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json pattern_json(const ResidualPattern& p) {
  return {{"position", number_or_null(p.position)},
          {"speed", number_or_null(p.speed)},
          {"torque", number_or_null(p.torque)},
          {"previous", number_or_null(p.previous)},
          {"spectrum_hz", numbers_or_null(p.spectrum_hz)},
          {"spectrum", numbers_or_null(p.spectrum)}};
}

ResidualPattern pattern_from(const Json& j) {
  return {number_or_nan(j.at("position")),     number_or_nan(j.at("speed")),
          number_or_nan(j.at("torque")),       number_or_nan(j.at("previous")),
          numbers_or_nan(j.at("spectrum_hz")), numbers_or_nan(j.at("spectrum"))};
}

Json joint_json(const JointExcitation& e) {
  return {{"q_low", number_or_null(e.q_low)},
          {"q_high", number_or_null(e.q_high)},
          {"fastest_forward", number_or_null(e.fastest_forward)},
          {"fastest_back", number_or_null(e.fastest_back)},
          {"forward", number_or_null(e.forward)},
          {"lacks", e.lacks}};
}

JointExcitation joint_from(const Json& j) {
  return {number_or_nan(j.at("q_low")),           number_or_nan(j.at("q_high")),
          number_or_nan(j.at("fastest_forward")), number_or_nan(j.at("fastest_back")),
          number_or_nan(j.at("forward")),         j.at("lacks")};
}

Json parameter_json(const ParameterExcitation& e) {
  return {{"name", e.name}, {"own", number_or_null(e.own)}, {"mixed_with", e.mixed_with}};
}

Json weakest_json(const std::pair<std::string, double>& w) {
  return {{"name", w.first}, {"weight", number_or_null(w.second)}};
}

Json excitation_json(const Excitation& e) {
  return {{"joints", list_of<Json>(e.joints, joint_json)},
          {"parameters", list_of<Json>(e.parameters, parameter_json)},
          {"weakest", list_of<Json>(e.weakest, weakest_json)}};
}

Excitation excitation_from(const Json& j) {
  Excitation e;
  for (const Json& joint : j.at("joints")) e.joints.push_back(joint_from(joint));
  for (const Json& p : j.at("parameters"))
    e.parameters.push_back({p.at("name"), number_or_nan(p.at("own")), p.at("mixed_with")});
  for (const Json& w : j.at("weakest")) e.weakest.emplace_back(w.at("name"), number_or_nan(w.at("weight")));
  return e;
}

Json value_json(const LogValue& v) {
  return {{"log", v.log + 1},
          {"value", number_or_null(v.value)},
          {"std", number_or_null(v.std)},
          {"ci95", {number_or_null(v.ci95[0]), number_or_null(v.ci95[1])}}};
}

LogValue value_from(const Json& j) {
  return {j.at("log").get<int>() - 1,
          number_or_nan(j.at("value")),
          number_or_nan(j.at("std")),
          {number_or_nan(j.at("ci95").at(0)), number_or_nan(j.at("ci95").at(1))}};
}

Json trend_json(const ParameterTrend& t) {
  return {{"name", t.name},
          {"unit", t.unit},
          {"by_log", list_of<Json>(t.by_log, value_json)},
          {"mean", number_or_null(t.mean)},
          {"chi_square", number_or_null(t.chi_square)},
          {"p_same", number_or_null(t.p_same)},
          {"slope", number_or_null(t.slope)},
          {"slope_std", number_or_null(t.slope_std)},
          {"p_level", number_or_null(t.p_level)},
          {"differs", t.differs},
          {"drifts", t.drifts}};
}

ParameterTrend trend_from(const Json& j) {
  ParameterTrend t;
  t.name = j.at("name");
  t.unit = j.at("unit");
  for (const Json& value : j.at("by_log")) t.by_log.push_back(value_from(value));
  t.mean = number_or_nan(j.at("mean"));
  t.chi_square = number_or_nan(j.at("chi_square"));
  t.p_same = number_or_nan(j.at("p_same"));
  t.slope = number_or_nan(j.at("slope"));
  t.slope_std = number_or_nan(j.at("slope_std"));
  t.p_level = number_or_nan(j.at("p_level"));
  t.differs = j.at("differs");
  t.drifts = j.at("drifts");
  return t;
}

}  // namespace

void add_verdicts(const Identification& id, Json& document) {
  document["residual_repeats_with"] = list_of<Json>(id.residual_patterns, pattern_json);
  document["excitation"] = excitation_json(id.excitation);
  document["trend"] = list_of<Json>(id.trends, trend_json);
}

void read_verdicts(const Json& document, Identification& id) {
  if (!document.contains("excitation")) return;
  for (const Json& p : document.at("residual_repeats_with")) id.residual_patterns.push_back(pattern_from(p));
  id.excitation = excitation_from(document.at("excitation"));
  for (const Json& t : document.at("trend")) id.trends.push_back(trend_from(t));
}

}  // namespace faultline
