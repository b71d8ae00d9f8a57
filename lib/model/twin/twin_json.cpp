// SPDX-License-Identifier: MIT
#include "lib/model/twin/twin_json.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/json/json_fields.hpp"
#include "lib/model/twin/twin_fields.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Spread spread_from(const std::string& name) {
  for (const Spread spread : {Spread::uniform, Spread::log_uniform})
    if (name == to_string(spread)) return spread;
  throw Error(ErrorCode::input, "spread",
              "is \"" + name + "\", expected \"uniform\" or \"log_uniform\"; learn the model again");
}

}  // namespace

void fields(auto& v, MaybeConst<DrawRange> auto& range) {
  v("low", range.low);
  v("high", range.high);
  v.named("spread", range.spread, spread_from);
  v.unless_empty("either_sign", range.either_sign);
}

namespace {

Json fault_to_json(const FaultDescription& fault, const TwinFault& twin) {
  Json sizes = Json::array();
  for (int s = 0; s < fault.size_count; ++s) {
    Json size = fields_to_json<Json>(twin.size[s]);
    size["of"] = usual_of(fault.size[s].measure);
    sizes.push_back(size);
  }
  Json json{{"size", sizes}};
  if (fault.passes) json["length_s"] = fields_to_json<Json>(twin.length_s);
  return json;
}

void read_fault(const Json& json, const FaultDescription& fault, TwinFault& twin) {
  for (int s = 0; s < fault.size_count; ++s)
    twin.size[s] = fields_from_json<DrawRange>(json.at("size").at(s), "size");
  if (fault.passes) twin.length_s = fields_from_json<DrawRange>(json.at("length_s"), "length_s");
}

bool has_size(FaultKind kind) { return kind != FaultKind::unknown && describe(kind).size_count > 0; }

}  // namespace

Json twin_to_json(const TwinOptions& options) {
  FieldWriter<Json> writer;
  visit_twin_fields(options, [&](const char* key, const auto& value, const char*) { writer(key, value); });
  Json json = writer.json();
  for (int k = 0; k < kFaultKinds; ++k) {
    const FaultKind kind = static_cast<FaultKind>(k);
    if (has_size(kind)) json["faults"][to_string(kind)] = fault_to_json(describe(kind), options.faults[k]);
  }
  return json;
}

TwinOptions twin_from_json(const Json& json, const std::string& where) {
  TwinOptions options;
  try {
    FieldReader<Json> reader(json, where);
    visit_twin_fields(options, [&](const char* key, auto& value, const char*) { reader(key, value); });
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
