// SPDX-License-Identifier: MIT
#include "lib/model/twin/twin_json.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/model/twin/twin_fields.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json value_to_json(double value) { return value; }
Json value_to_json(int value) { return value; }
Json value_to_json(const DrawRange& range) {
  Json json{{"low", range.low}, {"high", range.high}, {"spread", to_string(range.spread)}};
  if (range.either_sign) json["either_sign"] = true;
  return json;
}

Spread spread_from(const std::string& name) {
  for (const Spread spread : {Spread::uniform, Spread::log_uniform})
    if (name == to_string(spread)) return spread;
  throw Error(ErrorCode::input, "spread",
              "is \"" + name + "\", expected \"uniform\" or \"log_uniform\"; learn the model again");
}

void read(const Json& json, double& value) { value = json.get<double>(); }
void read(const Json& json, int& value) { value = json.get<int>(); }
void read(const Json& json, DrawRange& range) {
  range = {json.at("low").get<double>(), json.at("high").get<double>(),
           spread_from(json.at("spread").get<std::string>()), json.value("either_sign", false)};
}

Json fault_to_json(const FaultDescription& fault, const TwinFault& twin) {
  Json sizes = Json::array();
  for (int s = 0; s < fault.size_count; ++s) {
    Json size = value_to_json(twin.size[s]);
    size["of"] = usual_of(fault.size[s].measure);
    sizes.push_back(size);
  }
  Json json{{"size", sizes}};
  if (fault.passes) json["length_s"] = value_to_json(twin.length_s);
  return json;
}

void read_fault(const Json& json, const FaultDescription& fault, TwinFault& twin) {
  for (int s = 0; s < fault.size_count; ++s) read(json.at("size").at(s), twin.size[s]);
  if (fault.passes) read(json.at("length_s"), twin.length_s);
}

bool has_size(FaultKind kind) { return kind != FaultKind::unknown && describe(kind).size_count > 0; }

}  // namespace

Json twin_to_json(const TwinOptions& options) {
  Json json;
  visit_twin_fields(
      options, [&](const char* key, const auto& value, const char*) { json[key] = value_to_json(value); });
  for (int k = 0; k < kFaultKinds; ++k) {
    const FaultKind kind = static_cast<FaultKind>(k);
    if (has_size(kind)) json["faults"][to_string(kind)] = fault_to_json(describe(kind), options.faults[k]);
  }
  return json;
}

TwinOptions twin_from_json(const Json& json, const std::string& where) {
  TwinOptions options;
  try {
    visit_twin_fields(options, [&](const char* key, auto& value, const char*) { read(json.at(key), value); });
    for (int k = 0; k < kFaultKinds; ++k) {
      const FaultKind kind = static_cast<FaultKind>(k);
      if (has_size(kind))
        read_fault(json.at("faults").at(to_string(kind)), describe(kind), options.faults[k]);
    }
  } catch (const Json::exception& error) {
    throw Error(ErrorCode::input, where, std::string("\"twin\" is damaged (") + error.what() + ")");
  }
  options.check();
  return options;
}

}  // namespace faultline
